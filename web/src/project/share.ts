// A project as the end of an address: all files, deflated. Nothing of it is sent to a server.

import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";

/** A project: its files, and the one that is open. */
export interface Project {
    files: Record<string, string>;
    open: string;
}

/** How a fragment with a project begins. */
export const KEY = "#p=";
/** What a link may unpack to at most: a link is not to be trusted. */
const BYTES_MAX = 4_000_000;

/** The fragment of an address that has the project. */
export function fragmentOf(project: Project): string {
    const bytes = deflateSync(strToU8(JSON.stringify(project)), { level: 9 });
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    return KEY + btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** Whether a value has the form of a project. */
export function isProject(value: unknown): value is Project {
    const one = value as Project | null;
    return (
        typeof one === "object" && one !== null && typeof one.open === "string" && typeof one.files === "object" && one.files !== null &&
        Object.values(one.files).every((text) => typeof text === "string") && Object.keys(one.files).length > 0
    );
}

/** The project of a fragment; null if it has none, an error if it is damaged. */
export function projectOf(fragment: string): Project | null {
    if (!fragment.startsWith(KEY)) return null;
    const text = atob(fragment.slice(KEY.length).replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    // A buffer of that size ends the unpacking of what would be larger.
    const unpacked = inflateSync(bytes, { out: new Uint8Array(BYTES_MAX) });
    const value: unknown = JSON.parse(strFromU8(unpacked));
    if (!isProject(value)) throw new Error("it has no files");
    return value;
}
