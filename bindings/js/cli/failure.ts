// What a user of the command did not get, and why: one line, exit code 2.

import { PliantError } from "../boundary/errors.js";

export class Failure extends Error {}

/** Runs work on a file; what goes wrong with it is a Failure that names the file. */
export async function onFile<T>(path: string, work: () => T | Promise<T>): Promise<T> {
  try {
    return await work();
  } catch (error) {
    if (error instanceof PliantError && error.code !== "aborted") {
      throw new Failure(`${path}: ${error.message}`, { cause: error });
    }
    throw isSystemError(error) ? new Failure(`${path}: ${describe(error)}`, { cause: error }) : error;
  }
}

function isSystemError(error: unknown): error is NodeJS.ErrnoException {
  return error instanceof Error && "syscall" in error && "code" in error;
}

const reasons: Record<string, string> = {
  ENOENT: "no such file or folder",
  EACCES: "no permission",
  EPERM: "no permission",
  EISDIR: "is a folder; expected a file",
  ENOTDIR: "a part of the path is not a folder",
  ENOSPC: "no space left",
  EROFS: "the file system is read-only",
  ERR_FS_FILE_TOO_LARGE: "too large",
};

function describe(error: NodeJS.ErrnoException): string {
  return reasons[error.code ?? ""] ?? error.message;
}
