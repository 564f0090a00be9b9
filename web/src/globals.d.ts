/** Names of files of the site with the hash of their content; `build.mjs` puts them in. */
declare const WASM_URL: string;
declare const TEXTS_URL: string;
declare const EXAMPLES_URL: string;
declare const WORKER_URL: string;
declare const LIVE_WORKER_URL: string;
declare const RUN_URL: string;
/** Of the service worker alone: the hash of the whole site, and all files of it. */
declare const BUILD: string;
declare const FILES: string[];
