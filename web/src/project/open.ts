// Which project is open, and where it is kept: a folder of the server, a shared link, what the browser has, or an example.

import type { Studio } from "../studio";
import { announce, find, note } from "../ui/dom";
import { button, el } from "../ui/dom";
import { dialog } from "../ui/dialog";
import { addFiles, loadExamples, mountCommands } from "./commands";
import { chooseFiles, FileBar } from "./filebar";
import { FolderStore, token } from "./folder";
import { workOffline } from "./offline";
import { KEY, projectOf, type Project } from "./share";
import { BrowserStore, keepFormer, type Store } from "./store";

const FIRST = "fig2.sense";

/** The project as it is kept. */
export interface Kept {
    changed(): void;
    listed(): void;
}

/** Shows both texts of a file that somebody else has changed, and asks for one. */
function choose(path: string, mine: string, theirs: string): Promise<"mine" | "theirs"> {
    return new Promise((resolve) => {
        let answer: "mine" | "theirs" = "mine";
        const take = (one: "mine" | "theirs") => {
            answer = one;
            close();
        };
        const side = (title: string, text: string, one: "mine" | "theirs") =>
            el("section", {}, el("h3", {}, title), el("pre", { tabindex: "0" }, text), button(`Keep ${title.toLowerCase()}`, () => take(one), { class: "main" }));
        const { host, close } = dialog(
            `${path} has changed on the disk`,
            el("p", {}, "Somebody else has changed it since it was read. Which text shall it be?"),
            el("div", { class: "both" }, side("The text here", mine, "mine"), side("The text on the disk", theirs, "theirs")),
        );
        host.addEventListener("cancel", (event) => event.preventDefault());
        host.addEventListener("close", () => resolve(answer));
    });
}

function folderStore(secret: string, studio: Studio): FolderStore {
    return new FolderStore(secret, {
        saved: (path) => {
            find("kept").textContent = `${path} saved`;
        },
        failed: (path, why) => note(`${path} was not saved: ${why}`, [], "saving"),
        conflict: choose,
        taken: (path, text) => studio.editor.write({ [path]: text }),
    });
}

/** Opens a project, and keeps what becomes of it. `forget` is called before another one is open. */
export function mountProject(studio: Studio, forget: () => void): Kept {
    const { editor } = studio;
    const secret = token();
    const full = () => note("The browser does not keep the project: download it before you close the page.", [], "full");
    const store: Store = secret === null ? new BrowserStore(full) : folderStore(secret, studio);
    const upload = () => void chooseFiles().then((files) => addFiles(studio, files));
    const bar = new FileBar(find("files"), editor, upload, secret !== null);
    find("bar").append(el("span", { id: "kept", class: "kept" }));
    let isOpen = false;
    const project = (): Project => ({ files: editor.texts(), open: editor.path });
    const replace = (next: Project) => {
        forget();
        editor.replace(next.files, next.open);
    };
    mountCommands(studio, {
        isFolder: store.folder !== null,
        project,
        replace: (next, what) => {
            const before = project();
            if (store.folder === null) keepFormer(before);
            // In a folder its files stay, and new ones come beside them.
            replace(store.folder === null ? next : { files: { ...before.files, ...next.files }, open: next.open });
            const undo = { title: "Back to the one before", run: () => replace(before) };
            note(`${what} is open.`, store.folder === null ? [undo] : [], "opened");
        },
    });
    acceptDrops(studio);
    const begin = async () => {
        const first = await opened(store);
        if (first.isShared && store.folder === null) {
            const before = await store.load();
            if (before && JSON.stringify(before) !== JSON.stringify(first.project)) keepFormer(before);
        }
        editor.replace(first.project.files, first.project.open);
        isOpen = true;
        if (store.folder !== null) find("kept").textContent = `Folder ${store.folder}`;
        if (secret === null) void workOffline();
    };
    void begin().catch((why: unknown) => note(`The project could not be opened: ${String(why)}`, [], "opening"));
    addEventListener("hashchange", () => {
        const shared = fromAddress();
        if (!shared) return;
        keepFormer(project());
        replace(shared);
        announce("The shared project is open.");
    });
    return {
        changed: () => {
            if (!isOpen) return;
            store.keep(project());
            // The address has the project as it was shared, not as it has become.
            if (location.hash.startsWith(KEY)) history.replaceState(null, "", location.pathname + location.search);
        },
        listed: () => {
            bar.update();
            if (isOpen) store.keep(project());
        },
    };
}

function fromAddress(): Project | null {
    try {
        return projectOf(location.hash);
    } catch {
        note("The shared address is damaged: it may have been cut off when it was copied.", [], "shared");
        return null;
    }
}

/** The project to begin with. */
async function opened(store: Store): Promise<{ project: Project; isShared: boolean }> {
    const shared = fromAddress();
    if (shared && token() === null) return { project: shared, isShared: true };
    const kept = await store.load();
    if (kept && Object.keys(kept.files).length > 0) return { project: kept, isShared: false };
    const examples = await loadExamples();
    const { files, open } = examples.find((one) => one.open === FIRST) ?? { files: { [FIRST]: "" }, open: FIRST };
    return { project: { files, open }, isShared: false };
}

/** Takes files that are dropped onto the page. */
function acceptDrops(studio: Studio): void {
    addEventListener("dragover", (event) => {
        if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
    });
    addEventListener("drop", (event) => {
        const files = event.dataTransfer?.files;
        if (!files || files.length === 0) return;
        event.preventDefault();
        void addFiles(studio, files);
    });
}
