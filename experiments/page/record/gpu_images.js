// Images of a recording as textures of WebGL 2.

/// By the names of ssrlab's formats: those of WebGL, and how texels are handed over.
const glFormats = {
    r8: {internal: "R8", layout: "RED", type: "UNSIGNED_BYTE"},
    rg8: {internal: "RG8", layout: "RG", type: "UNSIGNED_BYTE"},
    rgba8: {internal: "RGBA8", layout: "RGBA", type: "UNSIGNED_BYTE"},
    rgba8_srgb: {internal: "SRGB8_ALPHA8", layout: "RGBA", type: "UNSIGNED_BYTE"},
    r16f: {internal: "R16F", layout: "RED", type: "FLOAT"},
    rg16f: {internal: "RG16F", layout: "RG", type: "FLOAT"},
    rgba16f: {internal: "RGBA16F", layout: "RGBA", type: "FLOAT"},
    r32f: {internal: "R32F", layout: "RED", type: "FLOAT"},
    rg32f: {internal: "RG32F", layout: "RG", type: "FLOAT"},
    rgba32f: {internal: "RGBA32F", layout: "RGBA", type: "FLOAT"},
    r11g11b10f: {internal: "R11F_G11F_B10F", layout: "RGB", type: "FLOAT"},
    r32ui: {internal: "R32UI", layout: "RED_INTEGER", type: "UNSIGNED_INT"},
    d32f: {internal: "DEPTH_COMPONENT32F", attachment: "DEPTH_ATTACHMENT"},
    d24: {internal: "DEPTH_COMPONENT24", attachment: "DEPTH_ATTACHMENT"},
    d16: {internal: "DEPTH_COMPONENT16", attachment: "DEPTH_ATTACHMENT"},
    d32f_s8: {internal: "DEPTH32F_STENCIL8", attachment: "DEPTH_STENCIL_ATTACHMENT"},
};

/// The textures of a recording, and the framebuffers that draw to them, clear and read them. Row 0 of a texture is the
/// top row, as in Vulkan: nothing is turned over on the way, since gl_FragCoord and texelFetch count from row 0 in both.
export class GpuImages {
    constructor(gl, descriptions) {
        this.gl = gl;
        this.images = descriptions.map(description => this.create(description));
        this.framebuffers = new Map();
        this.samplers = new Map();
        this.nothing = {float: this.create({format: "r8", width: 1, height: 1, mips: 1}),
                        uint: this.create({format: "r32ui", width: 1, height: 1, mips: 1})};
    }

    create({format, width, height, mips}) {
        const {gl} = this, texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, texture);
        gl.texStorage2D(gl.TEXTURE_2D, mips, gl[glFormats[format].internal], width, height);
        return {texture, width, height, mips, format, ...glFormats[format]};
    }

    upload(place, {values, width, height}, mip = 0) {
        const {gl} = this, image = this.images[place];
        const data = image.type === "FLOAT"       ? values :
                     image.type === "UNSIGNED_INT" ? Uint32Array.from(values) :
                                                     Uint8Array.from(values, v => Math.round(255 * v));
        gl.bindTexture(gl.TEXTURE_2D, image.texture);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
        gl.texSubImage2D(gl.TEXTURE_2D, mip, 0, 0, width, height, gl[image.layout], gl[image.type], data);
    }

    /// With a texture unit; `filter` and the wraps are names of WebGL. Without an image: a texel that nothing looks at.
    bind(unit, place, filter, wrapU, wrapV, isUint) {
        const {gl} = this, image = place === null ? this.nothing[isUint ? "uint" : "float"] : this.images[place];
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(gl.TEXTURE_2D, image.texture);
        gl.bindSampler(unit, this.sampler(filter, wrapU, wrapV, image.mips > 1));
    }

    sampler(filter, wrapU, wrapV, hasMips) {
        const {gl, samplers} = this, key = [filter, wrapU, wrapV, hasMips].join();
        if (!samplers.has(key)) {
            const sampler = gl.createSampler();
            gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, gl[filter]);
            gl.samplerParameteri(
                sampler, gl.TEXTURE_MIN_FILTER, gl[hasMips ? `${filter}_MIPMAP_${filter}` : filter]);
            gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_S, gl[wrapU]);
            gl.samplerParameteri(sampler, gl.TEXTURE_WRAP_T, gl[wrapV]);
            samplers.set(key, sampler);
        }
        return samplers.get(key);
    }

    /// Makes drawing go to `targets` ([image, mip], by location) and to the image of `depth` (null: none).
    drawTo(targets, depth) {
        const {gl, framebuffers} = this, key = JSON.stringify([targets, depth]);
        const [first, mip] = targets[0] ?? [depth, 0];
        if (framebuffers.has(key)) {
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffers.get(key));
        } else {
            const framebuffer = gl.createFramebuffer();
            gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
            const attach = (attachment, image, level) => gl.framebufferTexture2D(
                gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, this.images[image].texture, level);
            targets.forEach(([image, level], i) => attach(gl.COLOR_ATTACHMENT0 + i, image, level));
            if (depth !== null) attach(gl[this.images[depth].attachment], depth, 0);
            gl.drawBuffers(targets.length ? targets.map((_, i) => gl.COLOR_ATTACHMENT0 + i) : [gl.NONE]);
            const status = gl.checkFramebufferStatus(gl.FRAMEBUFFER);
            if (status !== gl.FRAMEBUFFER_COMPLETE) {
                const names = targets.map(([image]) => this.images[image].format).join(", ");
                throw new Error(`This browser cannot draw to textures of the formats ${names}.`);
            }
            framebuffers.set(key, framebuffer);
        }
        gl.viewport(0, 0, Math.max(this.images[first].width >> mip, 1), Math.max(this.images[first].height >> mip, 1));
    }

    clear([place, mip], value) {
        const {gl} = this, {attachment, layout} = this.images[place];
        gl.disable(gl.SCISSOR_TEST);
        this.drawTo(attachment ? [] : [[place, mip]], attachment ? place : null);
        gl.depthMask(true);
        gl.stencilMask(255);
        if (attachment === "DEPTH_STENCIL_ATTACHMENT")
            gl.clearBufferfi(gl.DEPTH_STENCIL, 0, value[0], value[1]);
        else if (attachment)
            gl.clearBufferfv(gl.DEPTH, 0, [value[0]]);
        else if (layout === "RED_INTEGER")
            gl.clearBufferuiv(gl.COLOR, 0, value);
        else
            gl.clearBufferfv(gl.COLOR, 0, value);
    }

    /// Four channels of one mip as numbers, rows from the top.
    read(place, mip = 0) {
        const {gl} = this, {width, height, type} = this.images[place];
        const w = Math.max(width >> mip, 1), h = Math.max(height >> mip, 1);
        this.drawTo([[place, mip]], null);
        gl.readBuffer(gl.COLOR_ATTACHMENT0);
        if (type === "UNSIGNED_BYTE") {
            const bytes = new Uint8Array(4 * w * h);
            gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
            return Float32Array.from(bytes, v => v / 255);
        }
        if (type === "UNSIGNED_INT") {
            const numbers = new Uint32Array(4 * w * h);
            gl.readPixels(0, 0, w, h, gl.RGBA_INTEGER, gl.UNSIGNED_INT, numbers);
            return Float32Array.from(numbers);
        }
        const values = new Float32Array(4 * w * h);
        gl.readPixels(0, 0, w, h, gl.RGBA, gl.FLOAT, values);
        return values;
    }
}
