/** What the page gives to the panels "Run" and "Connect", and what it gets from them. */

/** The page around the panels: text, theme, files and announcements. */
export interface LiveStudio {
    /** The secret of the server that runs boards for the page; null where the page runs them by itself. */
    readonly token: string | null;
    /** The compiled module, for workers of its own. */
    module(): Promise<WebAssembly.Module>;
    /** The request for the text as it is now. */
    request(): { path: string; files: Record<string, string>; board?: string };
    /** Called when the text or its wiring has changed; returns a function that ends it. */
    onChange(listener: () => void): () => void;
    /** Light or dark, now and when it changes. */
    onTheme(listener: (isDark: boolean) => void): () => void;
    /** Offers a file for download or saving. */
    save(name: string, bytes: Uint8Array, type: string): void;
    /** Says something to everybody, also to screen readers. */
    announce(text: string): void;
}

/** The two panels, once mounted. */
export interface Live {
    show(panel: "run" | "connect"): void;
    dispose(): void;
}
