// The rules that a picture or a page of the tool brings along, apart from what they are for.

/** A picture or page without its own rules, and these. */
export function undressed(source: string): { text: string; rules: string } {
    const all: string[] = [];
    const text = source.replace(/<style>([^<]*)<\/style>/g, (_, rules: string) => {
        all.push(rules.replaceAll("&gt;", ">").replaceAll("&amp;", "&"));
        return "";
    });
    return { text, rules: all.join("\n") };
}

/** Rules that count always, and those for dark screens alone. */
export function rulesOf(css: string): { always: string; dark: string } {
    const all = new CSSStyleSheet();
    all.replaceSync(css);
    const texts = { always: "", dark: "" };
    for (const rule of all.cssRules) {
        if (rule instanceof CSSMediaRule) texts.dark += [...rule.cssRules].map((one) => one.cssText).join("\n");
        else texts.always += rule.cssText;
    }
    return texts;
}
