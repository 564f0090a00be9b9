// What changes on the bench: from the wiring as it was when the project was opened, or when somebody said so, to this one.

import type { Report } from "../../../crates/wasm/sensedsl.mjs";
import type { Solution } from "../talk";
import { announce, button, el } from "../ui/dom";
import { empty, printed, ReportView, table } from "./report";

interface End {
    board: string;
    pin: string;
    signal: string;
}

interface Changed {
    changes: { change: string; device: string; role: string; from: End | null; to: End | null }[];
}

function shown(end: End | null): string {
    return end ? `${end.pin} (${end.signal})` : "";
}

export class Changes extends ReportView {
    readonly id = "changes";
    readonly title = "Changes";
    private old: Solution | null = null;

    /** Takes the wiring as what later ones are compared with. */
    begin(solution: Solution | null): void {
        this.old = solution;
    }

    get hasBegun(): boolean {
        return this.old !== null;
    }

    protected override head(): HTMLElement[] {
        const take = () => {
            this.begin(this.studio.solution);
            this.update();
            announce("Later wirings are compared with this one.");
        };
        return [
            el("div", { class: "choice" }, el("p", {}, "Compared with the wiring when the project was opened, or when this was pressed:"), button("It is wired like this now", take)),
        ];
    }

    protected question(): object | null {
        return this.old;
    }

    protected ask(): Promise<Report> {
        return this.studio.tool.call("diff", [{ ...this.studio.request(), old: this.old ?? {} }], "diff");
    }

    protected show({ text, value }: Report): HTMLElement[] {
        const changes = (value as Changed | null)?.changes;
        if (!changes) return [printed(text ?? "", "Changes")];
        if (changes.length === 0) return [empty("Every wire stays where it is.")];
        const rows = changes.map(({ change, device, role, from, to }) => [change, device, role, shown(from), shown(to)]);
        return [table("Changes", ["Change", "Device", "Role", "From", "To"], rows)];
    }

    protected missing(): string {
        return "There is no earlier wiring to compare with.";
    }
}
