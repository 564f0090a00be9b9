// Cost with its proof, room and timing of a wiring.

import type { Report } from "../../../crates/wasm/sensedsl.mjs";
import type { Solution } from "../talk";
import { el } from "../ui/dom";
import { printed, ReportView, table } from "./report";

const KINDS = { solve: "Cost and proof", capacity: "Room left", timing: "Timing" } as const;
type Kind = keyof typeof KINDS;

interface Capacity {
    complete: boolean;
    capacity: { board: string; kind: string; more: number; blocked_by: string[] }[];
}

const SHOWN_MAX = 10;

function capacity({ capacity: all, complete }: Capacity): HTMLElement[] {
    const rows = all.map(({ board, kind, more, blocked_by }) => {
        const names = blocked_by.slice(0, SHOWN_MAX).join(" ");
        return [board, kind, more, blocked_by.length > SHOWN_MAX ? `${names} …` : names];
    });
    const about = "How many more devices of one kind fit, and what the next one lacks.";
    const note = complete ? [] : [el("p", {}, "There was no time for all of them.")];
    return [el("p", {}, about), table("Room left", ["Board", "Kind", "More", "The next one lacks"], rows), ...note];
}

function pins(solution: Solution, text: string): HTMLElement[] {
    const rows = solution.boards.flatMap(({ name, devices }) =>
        devices.flatMap((device) => device.wires.map((wire) => [name, device.chip ? `${device.chip}.${device.name}` : device.name, wire.role, wire.pin, wire.signal])),
    );
    const last = text.trim().split("\n").at(-1) ?? "";
    return [el("p", { class: "total" }, last), table("Pins", ["Board", "Device", "Role", "Pin", "Signal"], rows)];
}

/** A choice of reports, one at a time. */
export class Reports extends ReportView {
    readonly id = "reports";
    readonly title = "Reports";
    private kind: Kind = "solve";

    protected override head(): HTMLElement[] {
        const choose = (kind: Kind) => {
            this.kind = kind;
            this.update();
        };
        const radios = (Object.keys(KINDS) as Kind[]).map((kind) =>
            el(
                "label",
                {},
                el("input", { type: "radio", name: "report", value: kind, checked: kind === this.kind, onchange: () => choose(kind) }),
                KINDS[kind],
            ),
        );
        return [el("fieldset", { class: "choice" }, el("legend", { class: "unseen" }, "Report"), ...radios)];
    }

    protected question(): object {
        return { kind: this.kind };
    }

    protected ask(): Promise<Report> {
        return this.studio.tool.call("report", [{ ...this.studio.request(), report: this.kind }], "report");
    }

    protected show({ text, value }: Report): HTMLElement[] {
        if (this.kind === "capacity" && value) return capacity(value as Capacity);
        const solution = value as Solution | null;
        if (this.kind === "solve" && solution && solution.cost !== null) return pins(solution, text ?? "");
        return [printed(text ?? "", KINDS[this.kind])];
    }

    protected missing(): string {
        return "There is no wiring to report on yet.";
    }
}
