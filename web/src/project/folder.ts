// A project in a folder of the machine that serves the page: each file is written as it is changed, and never over a
// change that somebody else has made.

import type { Project } from "./share";
import type { Store } from "./store";

/** What happens with files of the folder. */
export interface FolderListener {
    saved(path: string): void;
    failed(path: string, why: string): void;
    /** The file has changed on the disk since it was read: which text shall it be? */
    conflict(path: string, mine: string, theirs: string): Promise<"mine" | "theirs">;
    /** The text of the disk was taken. */
    taken(path: string, text: string): void;
}

interface Known {
    text: string;
    tag: string | null;
}

/** What the server has: the texts by path, what each is known by, and the file to begin with. */
interface Answer {
    folder: string;
    files: Record<string, string>;
    etags: Record<string, string>;
    open: string | null;
}

const WAIT_MS = 500;

/** The secret that the server has put into the page; null on a static site. */
export function token(): string | null {
    return document.querySelector<HTMLMetaElement>('meta[name="sensedsl-token"]')?.content ?? null;
}

function place(path: string): string {
    return `/api/files/${path.split("/").map(encodeURIComponent).join("/")}`;
}

/** Keeps the project in the folder. */
export class FolderStore implements Store {
    folder = "";
    private readonly known = new Map<string, Known>();
    private timer: ReturnType<typeof setTimeout> | undefined;
    private next: Project | undefined;
    private writing: Promise<void> = Promise.resolve();

    constructor(
        private readonly secret: string,
        private readonly listener: FolderListener,
    ) {}

    async load(): Promise<Project | null> {
        const response = await fetch("/api/project", { headers: { "X-Sensedsl-Token": this.secret } });
        if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
        const { folder, files, etags, open } = (await response.json()) as Answer;
        this.folder = folder;
        for (const [path, text] of Object.entries(files)) this.known.set(path, { text, tag: etags[path] ?? null });
        return { files, open: open ?? Object.keys(files).find((path) => path.endsWith(".sense")) ?? "" };
    }

    keep(project: Project): void {
        this.next = project;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.flush(), WAIT_MS);
    }

    /** Writes what has changed, one file after the other. */
    private flush(): void {
        const project = this.next;
        this.next = undefined;
        if (!project) return;
        this.writing = this.writing.then(async () => {
            for (const [path, text] of Object.entries(project.files)) {
                if (this.known.get(path)?.text !== text) await this.put(path, text);
            }
            // What was renamed has its text in another file by now.
            for (const path of [...this.known.keys()]) {
                if (project.files[path] === undefined) await this.remove(path);
            }
        });
    }

    private async put(path: string, text: string): Promise<void> {
        try {
            const response = await this.send(path, text, this.known.get(path)?.tag ?? null);
            if (response.status === 409) await this.settle(path, text, await response.text(), response.headers.get("etag"));
            else if (response.ok) this.stored(path, text, response);
            else this.listener.failed(path, `${response.status} ${await response.text()}`);
        } catch (why) {
            this.listener.failed(path, why instanceof Error ? why.message : String(why));
        }
    }

    private send(path: string, body: string, tag: string | null): Promise<Response> {
        const headers = { ...this.headers(tag), "Content-Type": "text/plain;charset=utf-8" };
        return fetch(place(path), { method: "PUT", headers, body });
    }

    /** The secret, and what the file was when it was read: nothing, if it is new. */
    private headers(tag: string | null): Record<string, string> {
        const known: Record<string, string> = tag === null ? { "If-None-Match": "*" } : { "If-Match": tag };
        return { "X-Sensedsl-Token": this.secret, ...known };
    }

    /** Removes a file, unless somebody has changed it since. */
    private async remove(path: string): Promise<void> {
        try {
            const headers = this.headers(this.known.get(path)?.tag ?? null);
            const response = await fetch(place(path), { method: "DELETE", headers });
            this.known.delete(path);
            if (response.status === 409) this.listener.failed(path, "it has changed on the disk since, so it was not removed");
            else if (!response.ok) this.listener.failed(path, `${response.status} ${await response.text()}`);
        } catch (why) {
            this.listener.failed(path, why instanceof Error ? why.message : String(why));
        }
    }

    private stored(path: string, text: string, response: Response): void {
        this.known.set(path, { text, tag: response.headers.get("etag") });
        this.listener.saved(path);
    }

    private async settle(path: string, mine: string, theirs: string, tag: string | null): Promise<void> {
        this.known.set(path, { text: theirs, tag });
        if ((await this.listener.conflict(path, mine, theirs)) === "theirs") {
            this.listener.taken(path, theirs);
            return;
        }
        const response = await this.send(path, mine, tag);
        if (response.ok) this.stored(path, mine, response);
        else this.listener.failed(path, `${response.status} ${await response.text()}`);
    }
}
