// The program `sensedsl` on this machine: where it is, and how it is run.

import { execFile, spawn } from "node:child_process";
import { homedir } from "node:os";
import * as vscode from "vscode";

/** How long a program may take to say that it has a language server. */
const ASKED_MAX_MS = 10_000;

/** The program of the settings or in `PATH`; none where there is none that has a language server. */
export async function findProgram(): Promise<string | undefined> {
    const set = vscode.workspace.getConfiguration("sensedsl").get<string>("path", "").trim();
    const program = set || "sensedsl";
    const refusal = await whyNot(program);
    if (refusal === undefined) return program;
    if (set) {
        const text = `\`sensedsl.path\` is ${set}, which has no language server (${refusal}). The extension takes its own.`;
        void vscode.window.showWarningMessage(text, "Open settings").then((chosen) => {
            if (chosen) void vscode.commands.executeCommand("workbench.action.openSettings", "sensedsl.path");
        });
    }
    return undefined;
}

/** Why a program cannot be the server; nothing if it can. */
function whyNot(program: string): Promise<string | undefined> {
    return new Promise((resolve) => {
        // From a folder that no workspace has filled.
        const options = { cwd: homedir(), timeout: ASKED_MAX_MS };
        execFile(program, ["lsp", "--help"], options, (error) => resolve(error?.message.split("\n")[0]));
    });
}

/** What a program has printed, and its status; `null` if it was ended. */
export interface Ran {
    status: number | null;
    stdout: string;
    stderr: string;
}

/** Runs the program in a folder, until it ends or the token ends it. */
export function run(program: string, args: string[], cwd: string, cancel: vscode.CancellationToken): Promise<Ran> {
    return new Promise((resolve, reject) => {
        const child = spawn(program, args, { cwd, stdio: ["ignore", "pipe", "pipe"] });
        const ran: Ran = { status: null, stdout: "", stderr: "" };
        child.stdout.setEncoding("utf8").on("data", (text: string) => (ran.stdout += text));
        child.stderr.setEncoding("utf8").on("data", (text: string) => (ran.stderr += text));
        child.on("error", reject);
        child.on("close", (status) => resolve({ ...ran, status }));
        cancel.onCancellationRequested(() => child.kill());
    });
}
