// OpenEXR scan-line files of 16- and 32-bit floats, uncompressed or ZIP (https://openexr.com/en/latest/OpenEXRFileLayout.html):
// what ssrlab writes, and what it reads.
import { readFileSync, writeFileSync, renameSync, mkdirSync } from "node:fs";
import { dirname } from "node:path";
import { deflateSync, inflateSync } from "node:zlib";

const MAGIC = 20000630, VERSION = 2, NO_COMPRESSION = 0, ZIPS = 2, ZIP = 3, HALF = 1, FLOAT = 2;
const ROWS_OF_BLOCK = { [NO_COMPRESSION]: 1, [ZIPS]: 1, [ZIP]: 16 };

function halfToFloat(bits) {
    const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
    if (exponent === 31) return fraction ? NaN : sign * Infinity;
    return exponent === 0 ? sign * fraction * 2 ** -24 : sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/** Bytes of a ZIP block in their order: even and odd ones apart, as differences to the byte before. */
function unpack(block, size) {
    const packed = inflateSync(block), bytes = Buffer.alloc(size), half = (size + 1) >> 1;
    for (let i = 1; i < size; ++i) packed[i] = (packed[i - 1] + packed[i] - 128) & 255;
    for (let i = 0; i < size; ++i) bytes[i] = packed[(i >> 1) + (i & 1 ? half : 0)];
    return bytes;
}

function pack(bytes) {
    const size = bytes.length, half = (size + 1) >> 1, parted = Buffer.alloc(size), packed = Buffer.alloc(size);
    for (let i = 0; i < size; ++i) parted[(i >> 1) + (i & 1 ? half : 0)] = bytes[i];
    packed[0] = parted[0];
    for (let i = 1; i < size; ++i) packed[i] = (parted[i] - parted[i - 1] + 128) & 255;
    const deflated = deflateSync(packed);
    return deflated.length < size ? deflated : bytes;  // as the library does: a block as long as its rows is not packed
}

function readHeader(file, bytes) {
    if (bytes.length < 8 || bytes.readUInt32LE(0) !== MAGIC) throw new Error(`${file} is no OpenEXR file`);
    if (bytes.readUInt32LE(4) & 0x1a00) throw new Error(`${file} is tiled, deep or of several parts; scan lines are read`);
    const header = { channels: [] };
    let at = 8;
    const text = () => {
        const end = bytes.indexOf(0, at), found = bytes.toString("latin1", at, end);
        at = end + 1;
        return found;
    };
    while (bytes[at] !== 0) {
        const name = text(), type = text(), size = bytes.readUInt32LE(at), end = at + 4 + size;
        at += 4;
        if (type === "chlist") {
            while (bytes[at] !== 0) {
                const channel = { name: text(), type: bytes.readUInt32LE(at) };
                at += 16;
                if (channel.type !== HALF && channel.type !== FLOAT) throw new Error(`${file}: channel ${channel.name} holds no floats`);
                header.channels.push(channel);
            }
        } else if (name === "compression") header.compression = bytes[at];
        else if (name === "dataWindow") header.window = [0, 4, 8, 12].map((offset) => bytes.readInt32LE(at + offset));
        at = end;
    }
    if (!(header.compression in ROWS_OF_BLOCK)) throw new Error(`${file}: compression ${header.compression} is not read; write ZIP or none`);
    return { ...header, end: at + 1 };
}

/** {width, height, channels: {R: Float32Array, ...}}, rows from the top. */
export function readExr(file) {
    const bytes = readFileSync(file), header = readHeader(file, bytes), [left, top, right, bottom] = header.window;
    const width = right - left + 1, height = bottom - top + 1, rows = ROWS_OF_BLOCK[header.compression];
    const row_bytes = header.channels.reduce((sum, c) => sum + width * (c.type === HALF ? 2 : 4), 0);
    const channels = Object.fromEntries(header.channels.map((c) => [c.name, new Float32Array(width * height)]));
    for (let block = 0; block < Math.ceil(height / rows); ++block) {
        const offset = Number(bytes.readBigUInt64LE(header.end + 8 * block));
        const first = bytes.readInt32LE(offset) - top, count = Math.min(rows, height - first);
        const stored = bytes.subarray(offset + 8, offset + 8 + bytes.readUInt32LE(offset + 4));
        const data = stored.length === count * row_bytes ? stored : unpack(stored, count * row_bytes);
        let at = 0;
        for (let y = first; y < first + count; ++y)
            for (const { name, type } of header.channels)
                for (let x = 0; x < width; ++x) {
                    channels[name][y * width + x] = type === HALF ? halfToFloat(data.readUInt16LE(at)) : data.readFloatLE(at);
                    at += type === HALF ? 2 : 4;
                }
    }
    return { width, height, channels };
}

/** `channels`: {R: Float32Array, ...} with rows from the top; appears whole or not at all. */
export function writeExr(file, width, height, channels) {
    const names = Object.keys(channels).sort(), parts = [];
    const number = (value) => {
        const bytes = Buffer.alloc(4);
        bytes.writeInt32LE(value);
        return bytes;
    };
    const real = (value) => {
        const bytes = Buffer.alloc(4);
        bytes.writeFloatLE(value);
        return bytes;
    };
    const text = (value) => Buffer.from(value + "\0", "latin1");
    const attribute = (name, type, ...values) => {
        const value = Buffer.concat(values);
        parts.push(text(name), text(type), number(value.length), value);
    };
    const window = [0, 0, width - 1, height - 1].map(number);
    parts.push(number(MAGIC), number(VERSION));
    attribute("channels", "chlist", ...names.flatMap((name) => [text(name), number(FLOAT), number(0), number(1), number(1)]), Buffer.alloc(1));
    attribute("compression", "compression", Buffer.from([ZIP]));
    attribute("dataWindow", "box2i", ...window);
    attribute("displayWindow", "box2i", ...window);
    attribute("lineOrder", "lineOrder", Buffer.alloc(1));
    attribute("pixelAspectRatio", "float", real(1));
    attribute("screenWindowCenter", "v2f", real(0), real(0));
    attribute("screenWindowWidth", "float", real(1));
    parts.push(Buffer.alloc(1));
    const blocks = [];
    for (let first = 0; first < height; first += ROWS_OF_BLOCK[ZIP]) {
        const count = Math.min(ROWS_OF_BLOCK[ZIP], height - first), data = Buffer.alloc(count * width * names.length * 4);
        let at = 0;
        for (let y = first; y < first + count; ++y)
            for (const name of names)
                for (let x = 0; x < width; ++x) at = data.writeFloatLE(channels[name][y * width + x], at);
        const packed = pack(data);
        blocks.push(Buffer.concat([number(first), number(packed.length), packed]));
    }
    const table = Buffer.alloc(8 * blocks.length);
    let offset = parts.reduce((sum, part) => sum + part.length, 0) + table.length;
    blocks.forEach((block, i) => {
        table.writeBigUInt64LE(BigInt(offset), 8 * i);
        offset += block.length;
    });
    mkdirSync(dirname(file), { recursive: true });
    const temporary = `${file}.${process.pid}.tmp`;
    writeFileSync(temporary, Buffer.concat([...parts, table, ...blocks]));
    renameSync(temporary, file);
}
