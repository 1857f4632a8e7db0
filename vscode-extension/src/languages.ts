// The languages whose programs the server reads.
import type { TextDocument } from 'vscode';

export const LANGUAGES = ['gcode', 'apt', 'klartext'];

export function isProgram(document: TextDocument): boolean {
  return LANGUAGES.includes(document.languageId);
}
