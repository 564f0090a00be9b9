// What the buttons above do with the project: open, examples, download, share.

import type { Studio } from "../studio";
import { announce, button, el, find, note } from "../ui/dom";
import { dialog, menu, type Choice } from "../ui/dialog";
import { isDark, onTheme, toggleTheme } from "../ui/theme";
import { chooseFiles, readFiles, type Taken } from "./filebar";
import { fragmentOf, type Project } from "./share";
import { former } from "./store";
import { zipped } from "./zip";

interface Example extends Project {
    title: string;
    about: string;
}

/** What the commands need besides the studio. */
export interface Commands {
    /** Whether the project is a folder, which has other files. */
    isFolder: boolean;
    project(): Project;
    /** Takes another project in place of the one that is open, which is kept as the former one. */
    replace(project: Project, what: string): void;
}

const EMPTY: Project = {
    open: "robot.sense",
    files: { "robot.sense": "board Robot on STM32F4DiscoveryBoard {\n    sensor Light returns uint16 {\n        id = 1;\n        type = analog;\n    }\n}\n" },
};

let examples: Promise<Example[]> | undefined;

/** The examples that come with the studio. */
export function loadExamples(): Promise<Example[]> {
    examples ??= fetch(EXAMPLES_URL).then((response) => response.json() as Promise<Example[]>);
    return examples;
}

/** The name of the project, from that of its design. */
export function nameOf(path: string): string {
    return (path.split("/").pop() ?? path).replace(/\.sense$/, "");
}

async function gallery(commands: Commands): Promise<void> {
    const all = await loadExamples();
    const cards = all.map((example) => {
        const open = () => {
            close();
            commands.replace(commands.isFolder ? apart(example) : example, example.title);
        };
        return el("li", {}, el("button", { type: "button", class: "card", onclick: open }, el("strong", {}, example.title), el("span", {}, example.about)));
    });
    const { close } = dialog("Examples", el("ul", { class: "cards" }, ...cards));
}

/** An example of several files in a folder of its own, where their names are not those of other files. */
function apart({ title, files, open }: Example): Project {
    if (Object.keys(files).length === 1) return { files, open };
    const folder = title.toLowerCase().replaceAll(" ", "_");
    const all = Object.entries(files).map(([path, text]) => [`${folder}/${path}`, text] as const);
    return { files: Object.fromEntries(all), open: `${folder}/${open}` };
}

/** Tells which files were not taken. */
function tellRefused({ refused, unnamed }: Taken): void {
    if (refused.length > 0) note(`${refused.join(", ")}: only text files of up to 1 MB can be taken.`, [], "refused");
    if (unnamed.length > 0) note(`${unnamed.join(", ")}: a drawing is taken with the world (.toml) that has it as its map.`, [], "unnamed");
}

/** Takes files of the machine: into the project, or as a project of their own if it is a design that is open alone. */
export async function addFiles(studio: Studio, files: Iterable<File>): Promise<void> {
    const taken = await readFiles(files, studio.editor.texts());
    tellRefused(taken);
    const { texts } = taken;
    const first = Object.keys(texts)[0];
    if (first === undefined) return;
    studio.editor.write(texts);
    studio.editor.open(first);
    announce(`${Object.keys(texts).join(", ")} added`);
}

async function open(commands: Commands): Promise<void> {
    const taken = await readFiles(await chooseFiles(), {});
    tellRefused(taken);
    const { texts } = taken;
    const design = Object.keys(texts).find((path) => path.endsWith(".sense")) ?? Object.keys(texts)[0];
    if (design !== undefined) commands.replace({ files: texts, open: design }, design);
}

async function share(commands: Commands): Promise<void> {
    const { origin, pathname } = location;
    const address = origin + pathname + fragmentOf(commands.project());
    const field = el("textarea", { readonly: true, rows: 4, "aria-label": "Address" });
    field.value = address;
    const copied = async () => {
        try {
            await navigator.clipboard.writeText(address);
            state.textContent = "Copied.";
        } catch {
            field.select();
            state.textContent = "The browser blocked copying: press Ctrl-C.";
        }
    };
    const state = el("p", { role: "status" });
    const kilobytes = (address.length / 1000).toFixed(1);
    dialog(
        "Share",
        el("p", {}, `The address contains all files (${kilobytes} kB). They are not sent to any server.`),
        field,
        state,
        el("div", { class: "actions" }, button("Copy", () => void copied(), { class: "main" })),
    );
    field.select();
}

/** Generates the project, and offers it as one file. */
export async function downloadProject(studio: Studio): Promise<void> {
    const request = studio.request();
    announce("Generating …");
    try {
        const { files, diagnostics } = await studio.tool.call("project", [request]);
        if (!files) {
            const error = diagnostics.find((one) => one.severity === "error");
            note(`Nothing can be generated yet: ${error?.message ?? "there is no wiring"}.`, [], "download");
            return;
        }
        studio.save(`${nameOf(request.path)}.zip`, zipped(files), "application/zip");
        announce(`${Object.keys(files).length} files in ${nameOf(request.path)}.zip`);
    } catch (why) {
        note(`Nothing was generated: ${why instanceof Error ? why.message : String(why)}`, [], "download");
    }
}

function downloads(studio: Studio, commands: Commands, at: HTMLElement): void {
    const { left, bottom } = at.getBoundingClientRect();
    const { path, files } = studio.request();
    const encoded = new TextEncoder();
    const choices: Choice[] = [
        { title: "Project as .zip", about: "firmware, hosts, wiring sheet", run: () => void downloadProject(studio) },
        { title: `The text ${studio.editor.path}`, run: () => studio.save(nameOf(studio.editor.path) + (/\.[a-z]+$/.exec(studio.editor.path)?.[0] ?? ""), encoded.encode(files[studio.editor.path] ?? ""), "text/plain") },
    ];
    if (Object.keys(files).length > 1) choices.push({ title: "All texts as .zip", run: () => studio.save(`${nameOf(path)}-texts.zip`, zipped(commands.project().files), "application/zip") });
    const svg = studio.wiring?.svg;
    if (svg) choices.push({ title: "Picture as .svg", run: () => studio.save(`${nameOf(path)}.svg`, encoded.encode(svg), "image/svg+xml") });
    menu("Download", { x: left, y: bottom + 2 }, choices);
}

function openings(commands: Commands, at: HTMLElement): void {
    const { left, bottom } = at.getBoundingClientRect();
    const before = former();
    const choices: Choice[] = [
        { title: "Files of this machine …", run: () => void open(commands) },
        { title: "New design", run: () => commands.replace(EMPTY, "A new design") },
    ];
    if (before) choices.push({ title: "Previous project", about: Object.keys(before.files).join(", "), run: () => commands.replace(before, "The project before") });
    menu("Open", { x: left, y: bottom + 2 }, choices);
}

/** Puts the buttons above. */
export function mountCommands(studio: Studio, commands: Commands): void {
    const host = find("commands");
    const opener = button("Open", () => openings(commands, opener), { "aria-haspopup": "menu" });
    const downloader = button("Download", () => downloads(studio, commands, downloader), { "aria-haspopup": "menu", title: "Download (Ctrl-S: the project)" });
    const theme = button("◐", toggleTheme, { class: "quiet", title: "Light or dark" });
    onTheme(() => theme.setAttribute("aria-label", isDark() ? "Change to light" : "Change to dark"));
    host.append(
        opener,
        button("Examples", () => void gallery(commands)),
        downloader,
        button("Share", () => void share(commands)),
        button("Keys", keys, { class: "quiet keys" }),
        theme,
    );
    document.addEventListener("keydown", (event) => {
        if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "s") {
            event.preventDefault();
            void downloadProject(studio);
        }
    });
}

/** What the keys do. */
function keys(): void {
    const all: [string, string][] = [
        ["Ctrl-Space", "what can be written here"],
        ["Ctrl-.", "changes that are offered here, fixes first"],
        ["F2", "rename a device, chip, board or constant"],
        ["F12 or Ctrl-click", "go to the definition"],
        ["F8", "next problem"],
        ["Shift-Alt-F", "lay the text out"],
        ["Ctrl-F", "search"],
        ["Ctrl-Z, Ctrl-Y", "undo, redo; a dragged wire is one step"],
        ["Ctrl-S", "download the project"],
        ["Escape, then Tab", "leave the text"],
        ["In the picture: Enter", "go to the text of a part; on a wire's pin: move the wire"],
    ];
    const rows = all.map(([key, what]) => el("tr", {}, el("th", { scope: "row" }, el("kbd", {}, key)), el("td", {}, what)));
    dialog("Keys", el("table", {}, el("tbody", {}, ...rows)));
}
