/** Does one thing after another for each key; of those that wait, only the newest. */
export class Newest {
    readonly #waiting = new Map<string, (() => Promise<void>) | null>();

    /** Does it now, or once what is under way for the key is done. */
    run(key: string, work: () => Promise<void>): void {
        if (this.#waiting.has(key)) {
            this.#waiting.set(key, work);
            return;
        }
        this.#waiting.set(key, null);
        void this.#all(key, work);
    }

    async #all(key: string, first: () => Promise<void>): Promise<void> {
        let work: (() => Promise<void>) | null = first;
        while (work !== null) {
            // Whoever gave the work tells of its failure; a board that has ended has already done so.
            await work().catch(() => {});
            work = this.#waiting.get(key) ?? null;
            this.#waiting.set(key, null);
        }
        this.#waiting.delete(key);
    }
}
