// What a reader takes along: files, and texts for the clipboard.

import {h} from "./elements.js";

/// Whether `act` may be done here: what browsers may refuse (clipboard, address, full screen) throws.
export async function attempt(act) {
    try {
        await act();
        return true;
    } catch {
        return false;
    }
}

export function saveFile(blob, name) {
    const href = URL.createObjectURL(blob);
    h("a", {href, download: name}).click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
}

export async function copyText(text) {
    if (await attempt(() => navigator.clipboard.writeText(text))) return;
    const area = h("textarea", {readonly: true});  // where a page that is a file has no clipboard of its own
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
}
