// The page: puts the editor, the language server and the views together.

import { Editor } from "./language/editor";
import { designOf, type Studio } from "./studio";
import { autocompletion } from "@codemirror/autocomplete";
import { actions } from "./language/actions";
import { completionSource, hover } from "./language/completion";
import { hintField, refreshHints } from "./language/hints";
import { spanOf } from "./language/places";
import { Problems } from "./language/problems";
import { LanguageServer } from "./language/server";
import { Changes } from "./panels/changes";
import { liveViews } from "./panels/live";
import { Palette } from "./panels/palette";
import { Reports } from "./panels/reports";
import { Sheet } from "./panels/sheet";
import { Why } from "./panels/why";
import { WiringView } from "./panels/wiring";
import { mountProject, type Kept } from "./project/open";
import { download } from "./project/zip";
import { ToolWorker } from "./tool";
import { find, note } from "./ui/dom";
import { mountDivider } from "./ui/divider";
import { Tabs } from "./ui/tabs";
import type { Wiring } from "./talk";

const listeners = new Set<() => void>();
let typed_ms: number | undefined;
let project: Kept | undefined;

function tell(): void {
    for (const one of listeners) one();
}

function wired(wiring: Wiring | null, isNewest: boolean): void {
    studio.wiring = wiring;
    if (wiring?.is_current && wiring.answer?.cost != null) {
        studio.solution = wiring.answer;
        if (!changes.hasBegun) changes.begin(wiring.answer);
    }
    view.take(wiring, isNewest);
    if (!isNewest) return;
    if (typed_ms !== undefined) performance.measure("typing to picture", { start: typed_ms, end: performance.now() });
    typed_ms = undefined;
    void refreshHints(server, editor);
    tell();
}

const server: LanguageServer = new LanguageServer({
    problems: (path, problems) => void studio.problems.take(path, problems),
    wiring: (_, wiring, isNewest) => wired(wiring, isNewest),
    searching: (isSearching) => find("studio").classList.toggle("is-searching", isSearching),
    failed: (why) => note(`The tool could not be started: ${why}`, [{ title: "Reload", run: () => location.reload() }], "failed"),
});

const editor: Editor = new Editor(
    find("editor"),
    {
        changed: () => {
            typed_ms = performance.now();
            const texts = editor.texts();
            server.update(texts);
            server.show(designOf(texts, editor.path));
            project?.changed();
            tell();
        },
        listed: () => {
            const texts = editor.texts();
            server.update(texts);
            server.show(designOf(texts, editor.path));
            studio.problems.retain(editor.paths());
            project?.listed();
        },
        moved: () => {
            view.picture.mark(studio.here());
            if (tabs.current === "why") tabs.update();
        },
    },
    [hover(server), autocompletion({ override: [completionSource(server)] }), actions(() => studio), hintField],
);

const studio: Studio = {
    editor,
    server,
    tool: new ToolWorker(),
    problems: new Problems(find("problems"), editor, () => server),
    wiring: null,
    solution: null,
    request: () => {
        const files = editor.texts();
        return { path: designOf(files, editor.path), files };
    },
    goTo: (name, isFocused) => {
        const part = studio.wiring?.parts.find((one) => one.name === name);
        const path = designOf(editor.texts(), editor.path);
        const doc = editor.state(path)?.doc;
        if (part && doc) editor.go(path, spanOf(doc, part.selection_range), spanOf(doc, part.range), isFocused);
    },
    here: () => {
        const { state } = editor.view;
        if (editor.path !== designOf(editor.texts(), editor.path)) return [];
        const at = state.selection.main.head;
        const isHere = ({ range }: Wiring["parts"][number]) => {
            const { from, to } = spanOf(state.doc, range);
            return from <= at && at <= to;
        };
        return (studio.wiring?.parts ?? []).filter(isHere).map((part) => part.name);
    },
    onChange: (listener) => {
        listeners.add(listener);
        return () => listeners.delete(listener);
    },
    save: download,
};

const view = new WiringView(studio);
const changes = new Changes(studio);
const tabs: Tabs = new Tabs(find("view-tabs"), find("view-panels"), [
    view,
    new Palette(studio),
    new Why(studio),
    new Reports(studio),
    changes,
    new Sheet(studio),
    ...liveViews(studio),
]);
tabs.show("wiring");
listeners.add(() => tabs.update());
studio.problems.onChange(() => view.problems());
mountDivider(find("divider"));
project = mountProject(studio, () => {
    changes.begin(null);
    studio.wiring = null;
    studio.solution = null;
});
