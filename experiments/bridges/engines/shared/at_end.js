// What is put back however rendering ends: by itself, by a mistake, or by a signal, Ctrl-C say.
import { rmSync } from "node:fs";

const SIGNALS = { SIGHUP: 129, SIGINT: 130, SIGTERM: 143 };  // exit codes as shells have them

for (const [signal, code] of Object.entries(SIGNALS)) process.once(signal, () => process.exit(code));

/** Calls `clean` once: when the returned function is called, or else when this process exits. It must not wait for anything. */
export function atEnd(clean) {
    const once = () => {
        process.off("exit", once);
        clean();
    };
    process.prependListener("exit", once);  // the last one first: processes end before their folders are removed
    return once;
}

/** Ends a process that was spawned `detached`, with all that it has started. */
export function endGroup({ pid }) {
    try {
        if (pid) process.kill(-pid, "SIGKILL");
    } catch (error) {
        if (error.code !== "ESRCH") throw error;  // it has ended
    }
}

/** Removes a folder in which a process that was just ended may still be writing. */
export const removeFolder = (folder) => rmSync(folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 100 });
