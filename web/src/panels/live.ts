// The panels "Run" and "Connect", which are one thing with two faces. They are fetched when one of them is wanted.

import type { Live } from "../live/index";
import { token } from "../project/folder";
import type { Studio } from "../studio";
import { module } from "../tool";
import { announce, el, note } from "../ui/dom";
import { onTheme } from "../ui/theme";
import type { View } from "../ui/tabs";

type Panels = typeof import("../live/index");

/** The two views. */
export function liveViews(studio: Studio): View[] {
    const place = el("div", { class: "live-place" });
    let live: Promise<Live> | undefined;
    let shown: string | undefined;
    const mounted = async () => {
        const { mountLive } = (await import(new URL(RUN_URL, document.baseURI).href)) as Panels;
        const { request, onChange, save } = studio;
        return mountLive(place, { token: token(), module, request, onChange, onTheme, save, announce });
    };
    const failed = (why: unknown) => {
        live = undefined;
        shown = undefined;
        note(`The panel could not be loaded: ${why instanceof Error ? why.message : String(why)}`, [], "failed");
    };
    const of = (id: "run" | "connect", title: string): View => {
        let host: HTMLElement | undefined;
        return {
            id,
            title,
            mount(panel) {
                host = panel;
            },
            update() {
                if (shown === id) return;
                shown = id;
                host?.append(place);
                live ??= mounted();
                live.then((one) => {
                    if (shown === id) one.show(id);
                }, failed);
            },
        };
    };
    return [of("run", "Run"), of("connect", "Connect")];
}
