//! What the linear program suggests: its values in, a wiring to try or a branch out.
#![expect(clippy::indexing_slicing, reason = "all ids come from the model")]

use crate::search::{Branch, Engine, Prices};
use crate::state::Dead;

/// Values nearer to a whole number count as whole.
const WHOLE: f64 = 0.01;

impl Engine<'_> {
    /// Gives each device the alternative that the linear program gives it as a whole, and reads
    /// the wiring that the flow then has.
    pub(crate) fn round(&mut self) {
        let model = self.model;
        let mark = self.state.mark();
        let saved = self.flow.save();
        if self.decide_whole().is_ok()
            && self.settle().is_ok()
            && self.bound() < self.limit
            && let Ok(choices) = self.read()
        {
            let weight = model.evaluate(&choices);
            if weight < self.limit && self.floor.is_none_or(|floor| weight > floor) {
                self.limit = weight;
                self.best = Some((weight, choices));
            }
        }
        self.back(mark, &saved);
    }

    /// As many of the devices that are alike go to an alternative as it is worth in whole numbers.
    fn decide_whole(&mut self) -> Result<(), Dead> {
        let model = self.model;
        let Some(prices) = &self.prices else { return Err(Dead) };
        for class in (0..model.devices).filter(|&d| model.class[d] == d) {
            let devices: Vec<usize> =
                (class..model.devices).filter(|&d| model.class[d] == class).collect();
            let first = model.alts.range(class).start;
            for alt in model.alts.range(class) {
                let of = |d: usize| model.alts.range(d).start + alt - first;
                let has = |d: &&usize| self.state.decided(**d) == Some(of(**d));
                let have = devices.iter().filter(has).count();
                let whole = (prices.relaxation.value(model, alt) + WHOLE) as usize;
                let open: Vec<usize> = devices
                    .iter()
                    .map(|&d| of(d))
                    .filter(|&a| {
                        self.state.alt_on(a) && self.state.decided(model.alt_device[a]).is_none()
                    })
                    .take(whole.saturating_sub(have))
                    .collect();
                for alt in open {
                    self.state.decide(model, alt)?;
                }
            }
        }
        Ok(())
    }

    /// What to branch on by the values of the linear program; `fallback` where they do not tell.
    pub(crate) fn guided(&self, fallback: Branch) -> Branch {
        let (Branch::Alt(alt), Some(prices)) = (fallback, &self.prices) else { return fallback };
        let whole =
            || self.likeliest(prices, self.state.alts(self.model, self.model.alt_device[alt]));
        let branch = self.partly_open(prices).or_else(|| self.divided(prices)).or_else(whole);
        branch.map_or(fallback, Branch::Alt)
    }

    /// The alternative with the greatest value.
    fn likeliest(&self, prices: &Prices, alts: impl Iterator<Item = usize>) -> Option<usize> {
        let valued = alts.map(|alt| (prices.relaxation.value(self.model, alt), alt));
        valued.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|(_, alt)| alt)
    }

    /// Somebody goes to the facility that is opened most but not wholly, or nobody does.
    fn partly_open(&self, prices: &Prices) -> Option<usize> {
        let mut best = (WHOLE, None);
        for (index, facility) in prices.terms.facilities.iter().enumerate() {
            let part = prices.relaxation.opened(index);
            if part > best.0 && part < 1.0 - WHOLE {
                let open = |alt: &usize| {
                    self.state.alt_on(*alt)
                        && self.state.decided(self.model.alt_device[*alt]).is_none()
                };
                let alts = facility.alts.iter().copied().filter(open);
                best = self.likeliest(prices, alts).map_or(best, |alt| (part, Some(alt)));
            }
        }
        best.1
    }

    /// The alternative that is nearest to one more whole device.
    fn divided(&self, prices: &Prices) -> Option<usize> {
        let mut best = (WHOLE, None);
        for device in (0..self.model.devices).filter(|&d| self.state.device_left(d) > 1) {
            for alt in self.state.alts(self.model, device) {
                let value = prices.relaxation.value(self.model, alt);
                let part = value - (value + WHOLE).floor();
                if part > best.0 {
                    best = (part, Some(alt));
                }
            }
        }
        best.1
    }
}
