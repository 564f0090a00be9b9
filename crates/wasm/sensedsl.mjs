// SenseDSL in a page or in Node: the bytes of sensedsl_wasm.wasm in, the tool out. `sensedsl.d.mts` says what it has.
//
//     const tool = await load(fetch("sensedsl_wasm.wasm").then((response) => response.arrayBuffer()));
//     const { diagnostics, answer, svg, left_out } = tool({ path: "robot.sense", files: { "robot.sense": text } });

/** What a request has of its design; the rest is the call's own. */
const split = ({ path, files, board, target, ...own }) => ({ of: { path, files, board, target }, ...own });

export async function load(wasm) {
    const source = await wasm;
    const made = await WebAssembly.instantiate(source, {});
    // From bytes there are a module and an instance, from a module the instance alone.
    const { memory, reserve, buffer, ...exports } = (made.instance ?? made).exports;

    const put = (bytes) => {
        const at = reserve(bytes.length);
        // The memory may have grown, so it is looked at anew each time.
        new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
    };
    const write = (text) => put(new TextEncoder().encode(text));
    const got = (length) => new Uint8Array(memory.buffer, buffer(), length);
    const read = (length) => new TextDecoder().decode(got(length));
    const asked = (name) => (text) => {
        write(text);
        return read(exports[name]());
    };
    // From text to text, byte for byte.
    const raw = { answer: asked("answer"), call: asked("call"), message: asked("message"), settle: () => read(exports.settle()) };
    const json = (of) => (value) => JSON.parse(of(JSON.stringify(value)));
    const call = json(raw.call);
    const told = (name) => (request) => call({ do: name, ...split(request) });

    return Object.assign(json(raw.answer), {
        raw,
        message: json(raw.message),
        settle: () => JSON.parse(raw.settle()),
        project: told("project"),
        report: told("report"),
        why: told("why"),
        diff: told("diff"),
        places: told("places"),
        pin: told("pin"),
        boards: () => call({ do: "boards" }),
        parts: () => call({ do: "parts" }),
        board_svg: (name) => call({ do: "board_svg", name }),
        robot: told("robot"),
        run: (until_ms) => call({ do: "run", until_ms }),
        steer: (device, element, shown) => call({ do: "steer", device, element, shown }),
        host: told("host"),
        opened: (now_ms) => call({ do: "opened", now_ms }),
        set: (device, value) => call({ do: "set", device, value }),
        feed: (bytes, now_ms) => {
            put(bytes);
            return JSON.parse(read(exports.feed(now_ms)));
        },
        to_send: (now_ms) => got(exports.to_send(now_ms)).slice(),
        fill: (texts) => {
            const view = new DataView(texts.buffer, texts.byteOffset, texts.byteLength);
            for (let at = 0; at < texts.length; ) {
                const [address, length] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
                new Uint8Array(memory.buffer, address, length).set(texts.subarray(at + 8, at + 8 + length));
                at += 8 + length;
            }
        },
    });
}
