// Tasks for each file: check, generate, build, flash, simulate. They need the program.

import { basename } from "node:path";
import * as vscode from "vscode";
import type { Server } from "./server";

/** How many files have tasks of their own. */
const FILES_MAX = 50;

const COMMANDS = {
    check: { group: undefined, args: (file: string) => ["check", file] },
    generate: { group: vscode.TaskGroup.Build, args: (file: string) => ["generate", file, "-o", folderOf(file)] },
    build: { group: vscode.TaskGroup.Build, args: (file: string) => ["build", file] },
    flash: { group: undefined, args: (file: string) => ["flash", file] },
    simulate: { group: undefined, args: (file: string) => ["simulate", file] },
};

type Name = keyof typeof COMMANDS;

interface Definition extends vscode.TaskDefinition {
    command: Name;
    file: string;
    args?: string[];
}

/** Where `sensedsl build` generates into as well. */
function folderOf(file: string): string {
    return file.slice(0, file.length - basename(file).length) + "build";
}

export function registerTasks(context: vscode.ExtensionContext, server: Server): void {
    const provider: vscode.TaskProvider = {
        async provideTasks() {
            const { program } = server;
            if (program === undefined) return [];
            const files = await vscode.workspace.findFiles("**/*.sense", "**/{node_modules,target,build}/**", FILES_MAX);
            return files.flatMap((uri) => {
                const folder = vscode.workspace.getWorkspaceFolder(uri);
                if (!folder) return [];
                const file = vscode.workspace.asRelativePath(uri, false);
                return (Object.keys(COMMANDS) as Name[]).map((command) =>
                    taskOf(program, folder, { type: "sensedsl", command, file }),
                );
            });
        },
        resolveTask(task) {
            const { program } = server;
            const definition = task.definition as Definition;
            if (program === undefined || !(definition.command in COMMANDS)) return undefined;
            const isFolder = typeof task.scope === "object";
            const folder = isFolder ? (task.scope as vscode.WorkspaceFolder) : vscode.workspace.workspaceFolders?.[0];
            return folder ? taskOf(program, folder, definition) : undefined;
        },
    };
    context.subscriptions.push(vscode.tasks.registerTaskProvider("sensedsl", provider));
}

function taskOf(program: string, folder: vscode.WorkspaceFolder, definition: Definition): vscode.Task {
    const { args, group } = COMMANDS[definition.command];
    const all = [...args(definition.file), ...(definition.args ?? [])];
    const execution = new vscode.ProcessExecution(program, all, { cwd: folder.uri.fsPath });
    const name = `${definition.command} ${definition.file}`;
    const task = new vscode.Task(definition, folder, name, "sensedsl", execution, "$sensedsl");
    task.group = group;
    return task;
}
