/** Colours of lines, which differ in their dashes as well. Each has a contrast of at least 3 to 1 with the page. */

const LIGHT = ["#0b62c4", "#b8321f", "#1e7d34", "#7a35c9", "#955200", "#00707a", "#b0126b", "#505860"];
const DARK = ["#6cb2ff", "#ff8f7a", "#6fd389", "#c8a2ff", "#ffb35c", "#4fd6df", "#ff8ac7", "#c4c9d0"];

/** How a line is drawn, as borders are named and as lengths. */
interface Style {
    border: "solid" | "dashed" | "dotted" | "double";
    dashes: number[];
}

const THROUGH: Style = { border: "solid", dashes: [] };
const STYLES: Style[] = [
    THROUGH,
    { border: "dashed", dashes: [8, 3] },
    { border: "dotted", dashes: [3, 3] },
    { border: "double", dashes: [12, 2, 2, 2] },
];

/** The colour of the line at an index. */
export function colour(index: number, isDark: boolean): string {
    const all = isDark ? DARK : LIGHT;
    return all[index % all.length] ?? "currentColor";
}

/** The style of the line at an index, in which lines of one colour differ. */
export function style(index: number): Style {
    return STYLES[(index + Math.floor(index / LIGHT.length)) % STYLES.length] ?? THROUGH;
}

/** What else a plot is drawn with. */
export function ink(isDark: boolean): { text: string; grid: string } {
    return isDark ? { text: "#c4c9d0", grid: "#3a4149" } : { text: "#454d55", grid: "#dde1e5" };
}
