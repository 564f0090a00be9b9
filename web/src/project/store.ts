// Where a project is kept: in the browser, or in a folder of the machine that serves the page.

import type { Project } from "./share";
import { isProject } from "./share";

const KEY = "sensedsl.project";
const FORMER = "sensedsl.former";

/** A place for a project. */
export interface Store {
    /** The folder's name, or null for the browser. */
    readonly folder: string | null;
    load(): Promise<Project | null>;
    /** Keeps what has changed since. */
    keep(project: Project): void;
}

function read(key: string): Project | null {
    try {
        const value: unknown = JSON.parse(localStorage.getItem(key) ?? "null");
        return isProject(value) ? value : null;
    } catch {
        return null;
    }
}

function write(key: string, project: Project): boolean {
    try {
        localStorage.setItem(key, JSON.stringify(project));
        return true;
    } catch {
        return false;
    }
}

/** The project before the one that is open, which a link or an example has replaced. */
export function former(): Project | null {
    return read(FORMER);
}

/** Keeps a project that is about to be replaced. */
export function keepFormer(project: Project): void {
    write(FORMER, project);
}

/** Keeps the project in the browser. */
export class BrowserStore implements Store {
    readonly folder = null;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private next: Project | undefined;

    /** `full` is called if the browser does not keep it. */
    constructor(private readonly full: () => void) {
        addEventListener("pagehide", () => this.flush());
    }

    load(): Promise<Project | null> {
        return Promise.resolve(read(KEY));
    }

    keep(project: Project): void {
        this.next = project;
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.flush(), 300);
    }

    private flush(): void {
        if (this.next && !write(KEY, this.next)) this.full();
        this.next = undefined;
    }
}
