// `trunnion check` as a task: in short form for the problem matcher, or in full for a person at the terminal.
import * as vscode from 'vscode';
import { firstFolder } from './server';

/** Machine, dialect and tool of the settings, as options. */
export function checkArguments(): string[] {
  const settings = vscode.workspace.getConfiguration('trunnion');
  return ['machine', 'dialect', 'tool'].flatMap((key) => {
    const value = settings.get<string>(key, '');
    return value ? [`--${key}`, value] : [];
  });
}

/** A task that checks `path` with machine, dialect and tool of the settings. */
export function checkTask(program: string, path: string, name: string, form: 'short' | 'pretty'): vscode.Task {
  const folder = firstFolder();
  // the problem list shall be whole; a person at the terminal first sees the worst
  const rest = form === 'short' ? ['--limit', '0', path] : [path];
  const execution = new vscode.ProcessExecution(program, ['check', '--format', form, ...checkArguments(), ...rest], folder ? { cwd: folder } : {});
  const matcher = form === 'short' ? ['$trunnion'] : [];
  const scope = folder ? vscode.TaskScope.Workspace : vscode.TaskScope.Global;
  const task = new vscode.Task({ type: 'trunnion', path }, scope, name, 'trunnion', execution, matcher);
  task.presentationOptions = { clear: true, focus: form === 'pretty' };
  return task;
}

/** Offers "check" for the whole folder, and completes tasks of type `trunnion` in tasks.json. */
export function taskProvider(program: () => string | undefined): vscode.TaskProvider {
  const make = (path: string, name: string) => {
    const found = program();
    return found === undefined ? undefined : checkTask(found, path, name, 'short');
  };
  return {
    provideTasks: () => [make('.', 'check the folder')].filter((task) => task !== undefined),
    resolveTask: (task) => {
      const found = program();
      if (found === undefined) {
        return undefined;
      }
      const resolved = checkTask(found, task.definition['path'] ?? '.', task.name, 'short');
      resolved.definition = task.definition;
      return resolved;
    },
  };
}
