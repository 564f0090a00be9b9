// SenseDSL in a page or in Node: the bytes of sensedsl_web.wasm in, a function from request to answer out.
//
//     const ask = await load(fetch("sensedsl_web.wasm").then((response) => response.arrayBuffer()));
//     const { diagnostics, answer, svg, left_out } = ask({ path: "robot.sense", files: { "robot.sense": text } });

export async function load(bytes) {
    const { instance } = await WebAssembly.instantiate(await bytes, {});
    const { memory, reserve, answer, buffer } = instance.exports;

    // The answer as text, byte for byte.
    const askText = (request) => {
        const bytes = new TextEncoder().encode(request);
        const at = reserve(bytes.length);
        // The memory may have grown, so it is looked at anew each time.
        new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
        const length = answer();
        return new TextDecoder().decode(new Uint8Array(memory.buffer, buffer(), length));
    };
    const ask = (request) => JSON.parse(askText(JSON.stringify(request)));
    ask.text = askText;
    return ask;
}
