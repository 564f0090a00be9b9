// The test explorer: each file with a world is simulated and judged. It needs the program.
//
// The world of `robot.sense` is `robot.toml` beside it or in `worlds/`.

import { dirname } from "node:path";
import * as vscode from "vscode";
import { placesOf } from "./places";
import { run } from "./program";
import type { Server } from "./server";

const WORLDS = "**/*.toml";
const LEFT_OUT = "**/{node_modules,target,build}/**";

export function registerTests(context: vscode.ExtensionContext, server: Server): void {
    const controller = vscode.tests.createTestController("sensedsl", "SenseDSL");
    /** By the test's identifier. */
    const worlds = new Map<string, vscode.Uri>();

    const find = async () => {
        worlds.clear();
        const found = server.program === undefined ? [] : await pairs();
        const items = found.map(({ design, world }) => {
            const label = vscode.workspace.asRelativePath(design);
            const item = controller.createTestItem(design.toString(), label, design);
            item.description = vscode.workspace.asRelativePath(world);
            // The mark of the test stands beside the first line.
            item.range = new vscode.Range(0, 0, 0, 0);
            worlds.set(item.id, world);
            return item;
        });
        controller.items.replace(items);
    };
    controller.refreshHandler = find;
    controller.createRunProfile("Judge", vscode.TestRunProfileKind.Run, (request, cancel) => judgeAll(request, cancel), true);

    const judgeAll = async (request: vscode.TestRunRequest, cancel: vscode.CancellationToken) => {
        const out = new Set(request.exclude ?? []);
        const items = (request.include ?? [...controller.items].map(([, item]) => item)).filter((item) => !out.has(item));
        const testRun = controller.createTestRun(request);
        for (const item of items) testRun.enqueued(item);
        for (const item of items) {
            const world = worlds.get(item.id);
            const { program } = server;
            if (cancel.isCancellationRequested || !world || program === undefined) testRun.skipped(item);
            else await judge(testRun, item, world, program, cancel);
        }
        testRun.end();
    };

    const watcher = vscode.workspace.createFileSystemWatcher("**/*.{sense,toml}", false, true, false);
    const again = () => void find();
    watcher.onDidCreate(again);
    watcher.onDidDelete(again);
    context.subscriptions.push(controller, watcher, server.onStarted(again));
    void find();
}

/** The designs of the workspace that have a world. */
async function pairs(): Promise<{ design: vscode.Uri; world: vscode.Uri }[]> {
    const [designs, worlds] = await Promise.all([
        vscode.workspace.findFiles("**/*.sense", LEFT_OUT),
        vscode.workspace.findFiles(WORLDS, LEFT_OUT),
    ]);
    const known = new Map(worlds.map((world) => [world.toString(), world]));
    const found = designs.flatMap((design) => {
        const name = (design.path.split("/").pop() ?? "").replace(/\.sense$/, ".toml");
        const beside = [[name], ["worlds", name]].map((path) => vscode.Uri.joinPath(design, "..", ...path));
        const world = beside.map((uri) => known.get(uri.toString())).find((uri) => uri !== undefined);
        return world ? [{ design, world }] : [];
    });
    return found.sort((one, other) => (one.design.path < other.design.path ? -1 : 1));
}

async function judge(
    testRun: vscode.TestRun,
    item: vscode.TestItem,
    world: vscode.Uri,
    program: string,
    cancel: vscode.CancellationToken,
): Promise<void> {
    const design = item.uri;
    if (!design) return;
    testRun.started(item);
    const begin = Date.now();
    const args = ["simulate", design.fsPath, "--world", world.fsPath, "--judge"];
    try {
        const ran = await run(program, args, dirname(design.fsPath), cancel);
        const took_ms = Date.now() - begin;
        testRun.appendOutput((ran.stderr + ran.stdout).replace(/\r?\n/g, "\r\n"), undefined, item);
        if (ran.status === 0) testRun.passed(item, took_ms);
        else if (cancel.isCancellationRequested) testRun.skipped(item);
        else testRun.failed(item, messages(ran.stderr || ran.stdout, design), took_ms);
    } catch (error) {
        testRun.errored(item, new vscode.TestMessage(error instanceof Error ? error.message : String(error)));
    }
}

/** What was found, each at its place; all of it together where no place is told. */
function messages(output: string, design: vscode.Uri): vscode.TestMessage[] {
    const found = placesOf(output).filter(({ severity }) => severity === "error");
    if (found.length === 0) return [new vscode.TestMessage(output.trim())];
    return found.map(({ file, line, column, text }) => {
        const message = new vscode.TestMessage(text);
        const uri = file === undefined ? design : vscode.Uri.file(file);
        const at = new vscode.Position(Math.max(0, (line ?? 1) - 1), Math.max(0, (column ?? 1) - 1));
        message.location = new vscode.Location(uri, at);
        return message;
    });
}
