// What the view of the wiring and the editor say to each other.

export type ToView =
    | {
          type: "wiring";
          uri: string;
          name: string;
          /** The newest picture there is. */
          svg: string | null;
          /** Whether it is of the text as it is now. */
          isCurrent: boolean;
          /** The parts that stand in the text. */
          parts: string[];
          /** What is wrong with the text, where that is known. */
          why: string | null;
      }
    /** The cursor is in the blocks of these parts. */
    | { type: "cursor"; names: string[] };

export type ToEditor = { type: "ready" } | { type: "pick"; name: string; isByKey: boolean };
