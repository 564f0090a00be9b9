//! Reduced-cost fixing: subproblems as last assessed and a limit in, smaller domains out.

use super::Lagrangian;
use crate::bounds::dualized::Dualized;
use crate::bounds::subproblems::{Choosable, Group, SlotChoice};
use crate::domains::{Charge, Domains, Pruned};
use crate::index::SlotId;
use crate::model::{Holding, Model};

impl Lagrangian {
    /// Removes what no answer below the limit can use according to the last assessment. Returns
    /// whether anything was removed.
    pub(crate) fn fix(
        &mut self,
        dualized: &Dualized,
        model: &Model,
        domains: &mut Domains,
        limit: u64,
    ) -> Result<bool, Pruned> {
        let Some(most) = Self::most(dualized, model, domains, limit) else { return Ok(false) };
        // An answer of weight limit - 1 must survive.
        let room = ((most as i64) << dualized.shift) - self.value;
        let mark = domains.mark();
        for (index, group) in self.subproblems.groups.enumerate() {
            let margin = self.subproblems.margin[index];
            for option in self.subproblems.options.of(group.options) {
                self.fix_option(model, domains, group, option, (margin, room))?;
            }
        }
        self.fix_openings(dualized, model, domains, room)?;
        self.fix_penalties(dualized, model, domains, room)?;
        Ok(domains.mark() > mark)
    }

    fn fix_option(
        &self,
        model: &Model,
        domains: &mut Domains,
        group: &Group,
        option: &Choosable,
        (margin, room): (i64, i64),
    ) -> Result<(), Pruned> {
        // Where devices spread over the ways, each way is judged by itself.
        let spread = group.spread && !option.once;
        let over = if spread {
            option.cost - self.subproblems.cheapest[option.slots.at(0)] - margin
        } else {
            (option.cost - margin).max(0)
        };
        if !spread && over > room {
            for &device in &group.devices {
                domains.remove_alt(model, model.twin_alt(option.alt, device))?;
            }
            return Ok(());
        }
        for slot in option.slots {
            let cheapest = self.subproblems.cheapest[slot];
            for way in self.ways(slot) {
                let Some(id) = way.id else { continue };
                let cost = self.way_cost(way);
                let extra = if spread { (over + cost).max(0) } else { over + cost - cheapest };
                if extra > room {
                    for &device in &group.devices {
                        let alt = model.twin_alt(option.alt, device);
                        domains.remove_cand(model, model.twin_cand(id, alt))?;
                    }
                }
            }
        }
        Ok(())
    }

    fn fix_openings(
        &self,
        dualized: &Dualized,
        model: &Model,
        domains: &mut Domains,
        room: i64,
    ) -> Result<(), Pruned> {
        for opening in &self.subproblems.openings {
            let over = if opening.open { 0 } else { (opening.cost - opening.saves).max(0) };
            if over > room {
                for &alt in &dualized.facilities[opening.facility].alts {
                    domains.remove_alt(model, alt)?;
                }
                continue;
            }
            for slot in opening.slots {
                let cheapest = self.subproblems.cheapest[slot];
                for way in self.ways(slot) {
                    let extra = over + self.way_cost(way) - cheapest;
                    let Some(id) = way.id.filter(|_| extra > room) else { continue };
                    let c = &model.cand[id];
                    let Holding::Wire(wire) = model.holding[c.role] else { continue };
                    for &other in &model.wire_cands[wire] {
                        if model.cand[other].place() == c.place() {
                            domains.remove_cand(model, other)?;
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// Closes rules that would cost too much to violate, and pays those whose violation saves too
    /// much.
    fn fix_penalties(
        &self,
        dualized: &Dualized,
        model: &Model,
        domains: &mut Domains,
        room: i64,
    ) -> Result<(), Pruned> {
        for (penalty, &cost) in dualized.penalties.iter().zip(&self.subproblems.penalties) {
            if domains.rule[penalty.rule] != Charge::Open {
                continue;
            }
            if cost > room {
                domains.close_rule(model, penalty.rule)?;
            } else if -cost > room {
                domains.pay_rule(model, penalty.rule)?;
            }
        }
        Ok(())
    }

    fn ways(&self, slot: SlotId) -> &[SlotChoice] {
        self.subproblems.ways.of(self.subproblems.slots[slot])
    }
}
