// The panels "Run" and "Connect", which are one thing with two faces.

import { mountLive, type Live } from "../live/index";
import type { Studio } from "../studio";
import { module } from "../tool";
import { announce, el } from "../ui/dom";
import { onTheme } from "../ui/theme";
import type { View } from "../ui/tabs";

/** The two views. */
export function liveViews(studio: Studio): View[] {
    const place = el("div", { class: "live-place" });
    let live: Live | undefined;
    let shown: string | undefined;
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
                const { request, onChange, save } = studio;
                live ??= mountLive(place, { module, request, onChange, onTheme, save, announce });
                live.show(id);
            },
        };
    };
    return [of("run", "Run"), of("connect", "Connect")];
}
