/** The worlds of a project: which of its files they are, and which one a design is run in unless somebody chooses. */

/** Tables and keys of a world. */
const KEYS = ["seed", "devices", "plants", "fault", "command", "controllers"];
const HEADER = /^[ \t]*\[\[?[ \t]*"?([A-Za-z_][\w-]*)"?[ \t]*(?:\.[^\]\n]*)?\]/gm;
/** A world that a test of the design names. */
const OF_TEST = /^\s*world\s*=\s*"([^"\n]+)"/m;
const DEVICE = /\b(?:sensor|actuator)\s+([A-Za-z_]\w*)/g;

/** Whether a file is a world, by its tables: other programs have .toml files, too. */
export function isWorld(path: string, text: string): boolean {
    if (!path.endsWith(".toml")) return false;
    return [...text.matchAll(HEADER)].every(([, table = ""]) => KEYS.includes(table));
}

/** The worlds of a project. */
export function worldsOf(files: Record<string, string>): string[] {
    return Object.keys(files).filter((path) => isWorld(path, files[path] ?? ""));
}

/**
 * The world to run a design in unless somebody chooses: the one that its first test names, or else the only one that has
 * a device of it. Empty if there is none.
 */
export function usualWorld(path: string, files: Record<string, string>): string {
    const worlds = worldsOf(files);
    const text = files[path] ?? "";
    const named = OF_TEST.exec(text)?.[1];
    const of_test = named === undefined ? "" : beside(path, named);
    if (worlds.includes(of_test)) return of_test;
    const [first = "", ...others] = worlds.filter((world) => fits(files[world] ?? "", text, files));
    return others.length === 0 ? first : "";
}

/** Whether a world speaks of a device of a design, or of a file that the design uses. */
function fits(world: string, design: string, files: Record<string, string>): boolean {
    const words = new Set(world.match(/\w+/g));
    const used = Object.keys(files).filter((path) => path.endsWith(".sense") && design.includes(`"${path.split("/").pop()}"`));
    const texts = [design, ...used.map((path) => files[path] ?? "")];
    return texts.some((text) => [...text.matchAll(DEVICE)].some(([, name = ""]) => words.has(name)));
}

/** The path of a file that another one names. */
function beside(path: string, name: string): string {
    const parts = path.split("/").slice(0, -1);
    for (const part of name.split("/")) {
        if (part === "..") parts.pop();
        else if (part !== ".") parts.push(part);
    }
    return parts.join("/");
}
