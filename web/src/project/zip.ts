// The generated project as one file: the same input gives the same bytes.

import { strToU8, zipSync, type Zippable } from "fflate";

/** The earliest date that the format has; the time of day of the machine plays no part. */
const DATE = new Date(1980, 0, 1);

/** The files as a .zip, in the order of their paths. */
export function zipped(files: Record<string, string>): Uint8Array {
    const all: Zippable = {};
    for (const path of Object.keys(files).sort()) all[path] = [strToU8(files[path] ?? ""), { mtime: DATE, level: 9 }];
    return zipSync(all);
}

/** Offers a file for download. */
export function download(name: string, bytes: Uint8Array, type: string): void {
    const url = URL.createObjectURL(new Blob([bytes as BlobPart], { type }));
    const link = document.createElement("a");
    link.href = url;
    link.download = name;
    document.body.append(link);
    link.click();
    link.remove();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
