// The technique: its recorded commands, done again by WebGL 2.

import {fill} from "../elements/elements.js";
import {compared} from "./compare.js";
import {GpuImages} from "./gpu_images.js";

/// Bindings of uniform blocks. `Push` stands for what Vulkan has as push constants.
const blockBindings = {
    Camera: 0,
    Params: 1,
    Push: 2
};

export class Replay {
    /// `recording`: as experiments/live/record/record.cpp writes it; `texels`: what decodeTexels() gave. Fails with a sentence
    /// where the browser cannot run it.
    constructor(recording, texels) {
        this.recording = recording;
        this.texels = texels;
        this.canvas = document.createElement("canvas");
        const gl = this.gl = this.canvas.getContext("webgl2", {antialias: false, depth: false});
        if (!gl) throw new Error("This browser has no WebGL 2.");
        if (!gl.getExtension("EXT_color_buffer_float"))
            throw new Error("This browser's WebGL 2 cannot draw to floats (EXT_color_buffer_float).");
        const side = Math.max(...recording.images.map(image => Math.max(image.width, image.height)));
        if (side > gl.getParameter(gl.MAX_TEXTURE_SIZE))
            throw new Error(`This browser's WebGL 2 has no textures of ${side} pixels.`);
        this.timer = gl.getExtension("EXT_disjoint_timer_query_webgl2");
        this.queries = [];
        this.images = new GpuImages(gl, recording.images);
        recording.images.forEach((image, place) => {
            if (image.texels !== undefined) this.images.upload(place, texels[image.texels]);
        });
        this.buffers = Object.values(blockBindings).map(() => gl.createBuffer());
        gl.bindVertexArray(gl.createVertexArray());
        this.programs = this.compile(recording.programs);
        this.values = new Map(blockParameters(recording).map(p => [p.name, p.value]));
        this.frame = -1;  // the one whose results the images hold
    }

    /// Fails with a sentence where WebGL has refused something since the last call.
    requireNoError() {
        const {gl} = this, code = gl.getError();
        if (gl.isContextLost()) throw new Error("The browser took the GPU away from this page. Load the page again.");
        if (code !== gl.NO_ERROR) throw new Error(`This browser's WebGL 2 refused a command (error ${code}).`);
    }

    get renderer() {
        const {gl} = this, info = gl.getExtension("WEBGL_debug_renderer_info");
        return gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
    }

    /// All are started before the first is asked for, so that the browser may compile them side by side.
    compile(sources) {
        const {gl} = this;
        const shader = (type, source) => {
            const made = gl.createShader(type);
            gl.shaderSource(made, source);
            gl.compileShader(made);
            return made;
        };
        const vertex = shader(gl.VERTEX_SHADER, this.recording.vertex);
        const made = sources.map(({stage, fragment}) => {
            const program = gl.createProgram(), own = shader(gl.FRAGMENT_SHADER, fragment);
            gl.attachShader(program, vertex);
            gl.attachShader(program, own);
            gl.linkProgram(program);
            return {stage, program, own};
        });
        for (const {stage, program, own} of made)
            if (!gl.getProgramParameter(program, gl.LINK_STATUS))
                throw new Error(`This browser cannot compile ${stage}: ${
                    gl.getShaderInfoLog(own) || gl.getProgramInfoLog(program)}`);
        return made.map(m => this.described(m));
    }

    described({stage, program}) {
        const {gl} = this, samplers = [];
        for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORM_BLOCKS); ++i) {
            const name = gl.getActiveUniformBlockName(program, i);
            gl.uniformBlockBinding(program, i, blockBindings[name] ?? blockBindings.Push);
        }
        for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
            const {name, type} = gl.getActiveUniform(program, i);
            if (type === gl.SAMPLER_2D || type === gl.UNSIGNED_INT_SAMPLER_2D)
                samplers.push(
                    {name, isUint: type !== gl.SAMPLER_2D, location: gl.getUniformLocation(program, name)});
        }
        return {stage, program, samplers};
    }

    /// Sets a parameter of the uniform block. What was rendered with others is rendered again.
    set(name, value) {
        if (this.values.get(name) === value) return;
        this.values.set(name, value);
        this.frame = -1;
    }

    /// Renders the recorded frames up to the one at `place`, those that the images hold already excepted: what a frame
    /// looks like depends on those before it, and on nothing else.
    show(place) {
        if (place < this.frame) this.frame = -1;
        while (this.frame < place) this.render(++this.frame);
    }

    render(place) {
        const {gl, recording} = this, frame = recording.frames[place];
        for (const [image, texels] of Object.entries(frame.inputs)) this.images.upload(Number(image), this.texels[texels]);
        this.fill("Camera", Uint32Array.from(frame.camera));
        this.fill("Params", this.parameterBlock());
        const query = this.timer && this.queries.length < 8 ? gl.createQuery() : null;
        if (query) gl.beginQuery(this.timer.TIME_ELAPSED_EXT, query);
        for (const command of recording.command_lists[frame.commands]) this.run(command);
        if (!query) return;
        gl.endQuery(this.timer.TIME_ELAPSED_EXT);
        this.queries.push(query);
    }

    /// Times of rendered frames that the GPU has reported since the last call (ms); none without a timer.
    times() {
        const {gl} = this, done = [];
        if (!this.timer) return done;
        const isDisjoint = gl.getParameter(this.timer.GPU_DISJOINT_EXT);
        while (this.queries.length && gl.getQueryParameter(this.queries[0], gl.QUERY_RESULT_AVAILABLE)) {
            const query = this.queries.shift();
            if (!isDisjoint) done.push(gl.getQueryParameter(query, gl.QUERY_RESULT) * 1e-6);
            gl.deleteQuery(query);
        }
        return done;
    }

    /// Of a page that holds what each recorded pass wrote: does a frame's passes one by one, each on what was recorded,
    /// and compares what it writes: [{stage, image, mip, pixels, differing, largest, relative}], as compared() gives them.
    checkPasses(place) {
        const rows = [], {images, texels} = this;
        this.checked = ({check: [image, mip], stage, texels: recorded}) => {
            const {name, format} = this.recording.images[image], {values, channels} = texels[recorded];
            rows.push({stage, image: name, format, mip, ...compared(images.read(image, mip), values, channels)});
            images.upload(image, texels[recorded], mip);
        };
        this.frame = -1;
        while (this.frame < place) {
            rows.length = 0;
            this.render(++this.frame);
        }
        this.checked = null;
        this.frame = -1;  // the images hold what was recorded
        return rows;
    }

    fill(block, words) {
        const {gl} = this, binding = blockBindings[block], size = Math.ceil(Math.max(words.length, 4) / 4) * 4;
        const padded = new Uint32Array(size);
        padded.set(words);
        gl.bindBufferBase(gl.UNIFORM_BUFFER, binding, this.buffers[binding]);
        gl.bufferData(gl.UNIFORM_BUFFER, padded, gl.STREAM_DRAW);
    }

    /// std140 packs scalars one after the other.
    parameterBlock() {
        const all = blockParameters(this.recording), words = new Uint32Array(all.length);
        const floats = new Float32Array(words.buffer), ints = new Int32Array(words.buffer);
        all.forEach((p, i) => {
            const value = this.values.get(p.name);
            if (p.type === "float")
                floats[i] = value;
            else
                ints[i] = p.choices.length ? p.choices.indexOf(value) : Number(value);
        });
        return words;
    }

    run(command) {
        if (command.clear) return this.images.clear(command.clear, command.value);
        if (command.check) return this.checked?.(command);
        if (command.upload !== undefined) return this.images.upload(command.upload, this.texels[command.texels]);
        const {gl} = this, {program, samplers} = this.programs[command.program];
        gl.useProgram(program);
        if (command.push) this.fill("Push", Uint32Array.from(command.push));
        samplers.forEach(({name, isUint, location}, unit) => {
            const [, place, filter, wrapU, wrapV] =
                command.textures.find(t => t[0] === name) ?? [name, null, "NEAREST", "CLAMP_TO_EDGE", "CLAMP_TO_EDGE"];
            this.images.bind(unit, place, filter, wrapU, wrapV, isUint);
            gl.uniform1i(location, unit);
        });
        this.images.drawTo(command.targets, command.depth?.[0] ?? command.stencil?.[0] ?? null);
        this.setTests(command);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        gl.disable(gl.DEPTH_TEST);
        gl.disable(gl.STENCIL_TEST);
    }

    setTests({depth, stencil}) {
        const {gl} = this;
        if (depth) {
            const [, compare, isWritten] = depth;
            gl.enable(gl.DEPTH_TEST);
            gl.depthFunc(gl[compare]);
            gl.depthMask(isWritten);
        }
        if (!stencil) return;
        const [, isWritten, value] = stencil;
        gl.enable(gl.STENCIL_TEST);
        gl.stencilMask(255);
        gl.stencilFunc(isWritten ? gl.ALWAYS : gl.EQUAL, value, 255);
        gl.stencilOp(gl.KEEP, gl.KEEP, isWritten ? gl.REPLACE : gl.KEEP);
    }
}

/// Those of the block `Params`, in its order.
export const blockParameters = recording => recording.parameters.filter(p => p.is_uniform);
