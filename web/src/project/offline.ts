// Without a network: the service worker has the whole site.

import { note } from "../ui/dom";

function offer(worker: ServiceWorker): void {
    note("There is a newer version of the studio.", [{ title: "Use it now", run: () => worker.postMessage("use") }], "version");
}

/** Lets the site be used without a network, and says when there is a newer version of it. */
export async function workOffline(): Promise<void> {
    const { serviceWorker } = navigator;
    if (!serviceWorker) return;
    const hadOne = serviceWorker.controller !== null;
    serviceWorker.addEventListener("controllerchange", () => {
        if (hadOne) location.reload();
    });
    try {
        const registration = await serviceWorker.register("service.js");
        if (registration.waiting && hadOne) offer(registration.waiting);
        registration.addEventListener("updatefound", () => {
            const next = registration.installing;
            next?.addEventListener("statechange", () => {
                if (next.state === "installed" && hadOne) offer(next);
            });
        });
    } catch {
        // It works with a network.
    }
}
