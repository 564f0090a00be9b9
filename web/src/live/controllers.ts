import type { RobotInfo } from "../../../crates/wasm/sensedsl.mjs";

/** What is to be said of controllers whose code does not run, in parts: plain text, then code, in turns. None if nothing is. */
export function controllersNote(info: RobotInfo, isServed: boolean): string[] {
    const stand_ins = info.stand_ins ?? [];
    const idle = info.has_code ? [] : info.controllers.filter((one) => !stand_ins.includes(one));
    const parts: string[] = [];
    const [first] = idle;
    if (first !== undefined) {
        const names = listed(idle);
        const [has, sets, its] = idle.length === 1 ? ["has", "sets", "its"] : ["have", "set", "their"];
        if (isServed) {
            const files = idle.length === 1 ? "first file" : "first files";
            parts.push(`${names} ${has} no code yet and ${sets} nothing: `, "sensedsl generate", ` makes ${its} ${files}.`);
        } else {
            parts.push(
                `${names} ${sets} nothing here: a page cannot compile ${its} code. `, "sensedsl studio",
                " can, and a table ", `[controllers.${first}.OUTPUT]`, " of a world stands in for it.",
            );
        }
    }
    const held = info.has_code ? [] : stand_ins;
    if (held.length > 0) {
        const text = `${listed(held)} ${held.length === 1 ? "is" : "are"} run by the world’s PID.`;
        if (parts.length === 0) parts.push(text);
        else parts[parts.length - 1] += ` ${text}`;
    }
    return parts;
}

function listed(names: readonly string[]): string {
    return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}
