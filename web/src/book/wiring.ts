// The wiring of a listing as a table, and in one line.

import type { Solution } from "../talk";
import { el } from "../ui/dom";
import type { Problem } from "./problems";

interface Wire {
    role: string;
    pin: string;
    signal: string;
    usages?: number;
}

interface Device {
    name: string;
    chip?: string;
    unit?: string | null;
    wires: Wire[];
}

interface Board {
    name: string;
    devices: Device[];
    link?: { wires: Wire[] } | null;
}

function count(many: number, what: string): string {
    return `${many} ${what}${many === 1 ? "" : "s"}`;
}

/** What there is to say of a text in one line. */
export function sumOf(problems: Problem[], solution: Solution | null): string {
    const of = (severity: string) => problems.filter((one) => one.severity === severity).length;
    const wrong = (["error", "warning"] as const).filter((one) => of(one) > 0).map((one) => count(of(one), one));
    if (solution === null || solution.conflict || solution.cost === null) return [...wrong, "no wiring"].join(", ");
    // As `sensedsl solve` counts: a chip is one device, and the pins of the links are taken as well.
    const boards = solution.boards as Board[];
    const parts = boards.flatMap((board) => [...new Set(board.devices.map((one) => one.chip ?? one.name))]);
    const wires = ({ devices, link }: Board) => [...devices, ...(link ? [link] : [])].flatMap((one) => one.wires.map((wire) => wire.pin));
    const pins = boards.flatMap((board) => [...new Set(wires(board))]);
    const proof = solution.status === "optimal" ? ", proved optimal" : "";
    return [...wrong, `${count(parts.length, "device")} on ${count(pins.length, "pin")}, opportunity cost ${solution.cost}${proof}`].join(", ");
}

/** The wires of all devices. */
export function tableOf(solution: Solution): HTMLElement {
    const severalBoards = solution.boards.length > 1;
    const head = [...(severalBoards ? ["Board"] : []), "Device", "Role", "Pin", "Signal", "Unit", "Usages"];
    const rows = (solution.boards as Board[]).flatMap((board) =>
        board.devices.flatMap((device) =>
            device.wires.map((wire, at) => {
                const name = device.chip ? `${device.chip}.${device.name}` : device.name;
                const first = at === 0 ? [name] : [""];
                return [...(severalBoards ? [board.name] : []), ...first, wire.role, wire.pin, wire.signal, at === 0 ? (device.unit ?? "") : "", String(wire.usages ?? "")];
            }),
        ),
    );
    const body = rows.map((row) => el("tr", {}, ...row.map((one) => el("td", {}, one))));
    return el(
        "div",
        { class: "playground-scroll", tabindex: "0", role: "region", "aria-label": "Wiring" },
        el("table", {}, el("thead", {}, el("tr", {}, ...head.map((one) => el("th", { scope: "col" }, one)))), el("tbody", {}, ...body)),
    );
}
