// The service worker: the whole site in a cache, so that the studio works without a network. A new version is fetched as a
// whole before it is used, and used once no page of the old one is open or somebody asks for it.

/** What there is in a service worker, as far as it is used. */
interface Service {
    addEventListener(type: "install" | "activate", listener: (event: { waitUntil(done: Promise<unknown>): void }) => void): void;
    addEventListener(type: "message", listener: (event: MessageEvent) => void): void;
    addEventListener(type: "fetch", listener: (event: { request: Request; respondWith(answer: Promise<Response>): void }) => void): void;
    skipWaiting(): Promise<void>;
    clients: { claim(): Promise<void> };
    location: Location;
}

const service = self as unknown as Service;
const PREFIX = "sensedsl-";
const NAME = PREFIX + BUILD;

async function fill(): Promise<void> {
    const cache = await caches.open(NAME);
    // Past the browser's own cache: that may have another version.
    await cache.addAll(FILES.map((name) => new Request(name, { cache: "reload" })));
}

async function clear(): Promise<void> {
    const names = await caches.keys();
    const old = names.filter((name) => name.startsWith(PREFIX) && name !== NAME);
    await Promise.all(old.map((name) => caches.delete(name)));
    await service.clients.claim();
}

async function answer(request: Request): Promise<Response> {
    const cache = await caches.open(NAME);
    const wanted = request.mode === "navigate" ? "index.html" : request;
    return (await cache.match(wanted, { ignoreSearch: true })) ?? fetch(request);
}

service.addEventListener("install", (event) => event.waitUntil(fill()));
service.addEventListener("activate", (event) => event.waitUntil(clear()));
service.addEventListener("message", ({ data }) => {
    if (data === "use") void service.skipWaiting();
});
service.addEventListener("fetch", (event) => {
    const { request } = event;
    const isOurs = request.method === "GET" && new URL(request.url).origin === service.location.origin;
    if (isOurs) event.respondWith(answer(request));
});
