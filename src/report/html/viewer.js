// The 3D view of the report: orbits a camera about the mesh in the data block `mesh`. WebGL 2, drawn only when something changes.
// Coordinates are east, north, up about a local origin; depths are design minus ground, negative in cut.
(() => {
  "use strict";
  const box = document.getElementById("view");
  const data = document.getElementById("mesh");
  if (!box || !data) return;
  const part = (name) => box.querySelector(`[data-part="${name}"]`);
  const [canvas, hint, readout, needle] = ["canvas", "hint", "readout", "needle"].map(part);
  const state = (name, message) => {
    box.dataset.state = name;
    hint.textContent = message || "";
    hint.hidden = !message;
  };

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const floats = (text) => new Float32Array(bytes(text));
  const whole = (text) => new Uint32Array(bytes(text));
  const scene = JSON.parse(data.textContent);
  const meshes = {};
  for (const name of ["works", "bare", "ground"]) {
    const m = scene[name];
    if (m) meshes[name] = { position: floats(m.position), value: m.value ? floats(m.value) : null, index: whole(m.index) };
  }
  const lines = scene.lines.map((l) => ({ kind: l.kind, ends: floats(l.ends) }));

  // The box of the works, for the mask, and some of its points, for the first view.
  const outline = [];
  const lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity];
  for (const m of [meshes.works, meshes.bare]) {
    for (let i = 0; m && i < m.position.length; i++) {
      lo[i % 3] = Math.min(lo[i % 3], m.position[i]);
      hi[i % 3] = Math.max(hi[i % 3], m.position[i]);
    }
  }
  for (const m of [meshes.works, meshes.bare]) {
    const step = m ? Math.ceil(m.position.length / 3 / 4000) : 1;
    for (let i = 0; m && i < m.position.length / 3; i += step) outline.push(m.position.slice(3 * i, 3 * i + 3));
  }
  const size = Math.max(Math.hypot(hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]), 1e-3);

  const FIELD = 30 * Math.PI / 180;
  const HOME = { azimuth: -0.45, pitch: 0.7 };
  const ABOVE = { azimuth: 0, pitch: Math.PI / 2 };
  const FRONT = { azimuth: 0, pitch: 0.12 };
  const camera = { azimuth: 0, pitch: 0, distance: 1, target: [0, 0, 0], height: 1 };
  const show = { works: true, ground: true, before: false, lines: true };

  const basis = () => {
    const [sa, ca] = [Math.sin(camera.azimuth), Math.cos(camera.azimuth)];
    const [se, ce] = [Math.sin(camera.pitch), Math.cos(camera.pitch)];
    return { right: [ca, -sa, 0], up: [sa * se, ca * se, ce], ahead: [sa * ce, ca * ce, -se] };
  };
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const less = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const eye = (ahead) => camera.target.map((t, i) => t - ahead[i] * camera.distance);
  // Size of the picture in px of the page; on paper one of its own.
  const PAPER = [1200, 680];
  let paper = false;
  const extent = () => (paper ? PAPER : [Math.max(canvas.clientWidth, 1), Math.max(canvas.clientHeight, 1)]);
  const aspect = () => extent()[0] / extent()[1];

  // All of the works in the picture, from the direction given; kept there when the window changes, until the camera is moved.
  let kept = null;
  const look = (view) => {
    kept = view;
    Object.assign(camera, view);
    const { right, up, ahead } = basis();
    camera.target = [0, 1, 2].map((i) => 0.5 * (lo[i] + hi[i]) * (i === 2 ? camera.height : 1));
    const tan = Math.tan(FIELD / 2);
    let distance = 0;
    for (const [x, y, z] of outline) {
      const corner = less([x, y, z * camera.height], camera.target);
      const near = -dot(corner, ahead);
      distance = Math.max(distance, near + Math.abs(dot(corner, right)) / (tan * aspect()), near + Math.abs(dot(corner, up)) / tan);
    }
    camera.distance = Math.max(distance * 1.12, size * 0.01);
    redraw();
  };

  const matrix = () => {
    const { right, up, ahead } = basis();
    const from = eye(ahead);
    const near = camera.distance * 0.02, far = camera.distance + size * (4 + 2 * camera.height);
    const f = 1 / Math.tan(FIELD / 2), z = camera.height;
    const row = (axis, scale) => [axis[0] * scale, axis[1] * scale, axis[2] * scale * z, -dot(axis, from) * scale];
    const [x, y] = [row(right, f / aspect()), row(up, f)];
    const back = row(ahead, 1);
    const depth = back.map((v, i) => v * (far + near) / (far - near) - (i === 3 ? 2 * far * near / (far - near) : 0));
    return new Float32Array([0, 1, 2, 3].flatMap((i) => [x[i], y[i], depth[i], back[i]]));
  };

  const MESH = [`#version 300 es
    in vec3 position; in float value;
    uniform mat4 view; uniform float height; uniform vec4 plan;
    out vec3 world; out float depth; out vec2 place;
    void main() {
      world = vec3(position.xy, position.z * height);
      depth = value;
      place = (position.xy - plan.xy) * plan.zw;
      gl_Position = view * vec4(position, 1.0);
    }`, `#version 300 es
    precision highp float;
    in vec3 world; in float depth; in vec2 place;
    uniform int mode; uniform float most[2]; uniform vec3 cut, fill, pale, plain; uniform float alpha; uniform int masked;
    uniform sampler2D mask;
    out vec4 colour;
    void main() {
      if (masked != 0) {
        bool inside = all(greaterThan(place, vec2(0.0))) && all(lessThan(place, vec2(1.0))) && texture(mask, place).r > 0.98;
        if (inside == (masked == 1)) discard;
      }
      vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
      if (normal.z < 0.0) normal = -normal;
      // The ground shows its relief; the works, whose colour means something, less of it.
      float lit = max(dot(normal, normalize(vec3(-0.5, 0.45, 0.75))), 0.0);
      float light = mode == 0 ? 0.5 + 0.5 * lit : 0.76 + 0.24 * lit;
      vec3 base = plain;
      if (mode == 1) {
        vec3 deep = depth < 0.0 ? cut : fill;
        float share = clamp(abs(depth) / max(depth < 0.0 ? most[0] : most[1], 1e-6), 0.0, 1.0);
        base = mix(pale, deep, share);
      } else if (mode == 2) {
        base = depth < 0.5 ? plain : depth < 1.5 ? mix(pale, fill, 0.75) : mix(pale, cut, 0.75);
      }
      colour = vec4(base * light, 1.0) * alpha;
    }`];
  const LINE = [`#version 300 es
    in vec2 corner; in vec3 from; in vec3 to;
    uniform mat4 view; uniform vec2 pixels; uniform float width;
    void main() {
      vec4 a = view * vec4(from, 1.0), b = view * vec4(to, 1.0);
      float near = 1e-4;
      if (a.w < near && b.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
      if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
      if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
      vec2 along = (b.xy / b.w - a.xy / a.w) * pixels;
      along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
      vec4 end = corner.x < 0.5 ? a : b;
      vec2 aside = vec2(-along.y, along.x) * corner.y + along * (2.0 * corner.x - 1.0) * 0.5;
      end.xy += aside * width / pixels * end.w;
      end.z -= 4e-4 * end.w;
      gl_Position = end;
    }`, `#version 300 es
    precision highp float;
    uniform vec4 plain;
    out vec4 colour;
    void main() { colour = vec4(plain.rgb, 1.0) * plain.a; }`];
  const MASK_SIZE = 2048;
  const STYLE = {
    hinge: ["--view-line", 2.4], daylight: ["--view-daylight", 2.2], zero: ["--view-line", 1.4], boundary: ["--view-daylight", 1.6],
    breakline: ["--view-line", 1.0, 0.7], ridge: ["--view-crease", 1.0, 0.7], valley: ["--view-crease", 1.0, 0.7],
    level_curve: ["--view-level", 0.8, 0.5],
  };

  let gl = null, program = {}, plan = null, wanted = false;
  const compile = (sources) => {
    const made = gl.createProgram();
    [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((kind, i) => {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, sources[i]);
      gl.compileShader(shader);
      gl.attachShader(made, shader);
    });
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(made) || "link");
    const at = new Map();
    return {
      made,
      uniform: (name) => at.get(name) || at.set(name, gl.getUniformLocation(made, name)).get(name),
      attribute: (name) => gl.getAttribLocation(made, name),
    };
  };
  const buffer = (kind, values) => {
    const made = gl.createBuffer();
    gl.bindBuffer(kind, made);
    gl.bufferData(kind, values, gl.STATIC_DRAW);
  };
  const attribute = (index, count, stride, offset, divisor) => {
    if (index < 0) return;
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, count, gl.FLOAT, false, stride, offset);
    gl.vertexAttribDivisor(index, divisor);
  };

  // Everything the graphics card holds: made at the start, and again when it was lost.
  const prepare = () => {
    program = { mesh: compile(MESH), line: compile(LINE) };
    for (const m of Object.values(meshes)) {
      m.array = gl.createVertexArray();
      gl.bindVertexArray(m.array);
      buffer(gl.ARRAY_BUFFER, m.position);
      attribute(program.mesh.attribute("position"), 3, 0, 0, 0);
      if (m.value) {
        buffer(gl.ARRAY_BUFFER, m.value);
        attribute(program.mesh.attribute("value"), 1, 0, 0, 0);
      }
      buffer(gl.ELEMENT_ARRAY_BUFFER, m.index);
    }
    for (const l of lines) {
      l.array = gl.createVertexArray();
      gl.bindVertexArray(l.array);
      buffer(gl.ARRAY_BUFFER, new Float32Array([0, -1, 0, 1, 1, -1, 1, 1]));
      attribute(program.line.attribute("corner"), 2, 0, 0, 0);
      buffer(gl.ARRAY_BUFFER, l.ends);
      attribute(program.line.attribute("from"), 3, 24, 0, 1);
      attribute(program.line.attribute("to"), 3, 24, 12, 1);
    }
    gl.bindVertexArray(null);
    mask();
  };

  // The works from above in white: where the ground is left out.
  const mask = () => {
    const edge = 0.02 * Math.max(hi[0] - lo[0], hi[1] - lo[1], 1e-3);
    const [x, y, w, h] = [lo[0] - edge, lo[1] - edge, hi[0] - lo[0] + 2 * edge, hi[1] - lo[1] + 2 * edge];
    plan = [x, y, 1 / w, 1 / h];
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, MASK_SIZE, MASK_SIZE, 0, gl.RGBA, gl.UNSIGNED_BYTE, null);
    for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]]) gl.texParameteri(gl.TEXTURE_2D, key, value);
    const target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
    // The texture is drawn to here and read from later: never both at once.
    gl.bindTexture(gl.TEXTURE_2D, null);
    gl.viewport(0, 0, MASK_SIZE, MASK_SIZE);
    gl.clearColor(0, 0, 0, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.disable(gl.DEPTH_TEST);
    const down = new Float32Array([2 / w, 0, 0, 0, 0, 2 / h, 0, 0, 0, 0, 0, 0, -2 * x / w - 1, -2 * y / h - 1, 0, 1]);
    const white = [1, 1, 1];
    draw(["works", "bare"], down, { mode: 0, plain: white.map((v) => v * 4), pale: white, cut: white, fill: white, alpha: 1, masked: 0 });
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindTexture(gl.TEXTURE_2D, texture);
  };

  const draw = (names, view, look) => {
    const p = program.mesh;
    gl.useProgram(p.made);
    gl.uniformMatrix4fv(p.uniform("view"), false, view);
    gl.uniform1f(p.uniform("height"), camera.height);
    gl.uniform4fv(p.uniform("plan"), plan);
    gl.uniform1fv(p.uniform("most"), scene.most);
    for (const name of ["cut", "fill", "pale", "plain"]) gl.uniform3fv(p.uniform(name), look[name]);
    gl.uniform1f(p.uniform("alpha"), look.alpha);
    gl.uniform1i(p.uniform("masked"), look.masked);
    gl.uniform1i(p.uniform("mode"), look.mode);
    for (const name of names) {
      const m = meshes[name];
      if (!m) continue;
      gl.bindVertexArray(m.array);
      gl.drawElements(gl.TRIANGLES, m.index.length, gl.UNSIGNED_INT, 0);
    }
    gl.bindVertexArray(null);
  };

  const colour = (name) => {
    const hex = getComputedStyle(box).getPropertyValue(name).trim();
    return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255 || 0);
  };

  const paint = () => {
    wanted = false;
    if (!gl || gl.isContextLost()) return;
    const ratio = paper ? 2 : Math.min(window.devicePixelRatio || 1, 2);
    const [w, h] = extent().map((v) => Math.round(v * ratio));
    if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
    gl.viewport(0, 0, w, h);
    gl.clearColor(...colour("--view-sky"), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(1, 1);
    const view = matrix();
    const look = { cut: colour("--view-cut"), fill: colour("--view-fill"), pale: colour("--view-pale"), alpha: 1, masked: 0 };
    const grey = colour("--view-ground"), plain = colour("--view-platform");
    if (show.works) {
      draw(["works"], view, { ...look, plain, mode: scene.onGround ? 1 : 2 });
      gl.polygonOffset(2, 4);
      draw(["bare"], view, { ...look, plain, mode: 0 });
      gl.polygonOffset(1, 1);
    }
    if (show.ground) draw(["ground"], view, { ...look, plain: grey, mode: 0, masked: show.works ? 1 : 0 });
    gl.disable(gl.POLYGON_OFFSET_FILL);
    if (show.lines) {
      const p = program.line;
      gl.useProgram(p.made);
      gl.depthMask(false);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.uniformMatrix4fv(p.uniform("view"), false, view);
      gl.uniform2f(p.uniform("pixels"), w, h);
      for (const l of lines) {
        const [name, width, alpha = 1] = STYLE[l.kind] || ["--view-line", 1];
        gl.uniform4f(p.uniform("plain"), ...colour(name), alpha);
        gl.uniform1f(p.uniform("width"), width * ratio);
        gl.bindVertexArray(l.array);
        gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, l.ends.length / 6);
      }
      gl.bindVertexArray(null);
      gl.disable(gl.BLEND);
      gl.depthMask(true);
    }
    if (show.works && show.before) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
      draw(["ground"], view, { ...look, plain: grey, mode: 0, alpha: 0.45, masked: 2 });
      gl.depthMask(true);
      gl.disable(gl.BLEND);
    }
    needle.style.transform = `rotate(${-camera.azimuth}rad)`;
    state("drawn");
  };
  const redraw = () => {
    if (!wanted) requestAnimationFrame(paint);
    wanted = true;
  };

  // Moving the camera. `dx` and `dy` are pixels.
  const turn = (dx, dy) => {
    kept = null;
    camera.azimuth += dx * 0.008;
    camera.pitch = Math.min(Math.PI / 2, Math.max(-0.2, camera.pitch + dy * 0.008));
    redraw();
  };
  const pan = (dx, dy) => {
    kept = null;
    const { right, up } = basis();
    const scale = 2 * camera.distance * Math.tan(FIELD / 2) / extent()[1];
    camera.target = camera.target.map((t, i) => t + (up[i] * dy - right[i] * dx) * scale);
    redraw();
  };
  const zoom = (factor) => {
    kept = null;
    camera.distance = Math.min(size * 20, Math.max(size * 1e-3, camera.distance * factor));
    redraw();
  };

  const fingers = new Map();
  let moved = 0;
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.max(1, Math.hypot(a.x - b.x, a.y - b.y)) };
  };
  canvas.addEventListener("pointerdown", (e) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(e.pointerId);
    fingers.set(e.pointerId, { x: e.clientX, y: e.clientY });
    moved = fingers.size > 1 ? Infinity : 0;
  });
  canvas.addEventListener("pointermove", (e) => {
    const finger = fingers.get(e.pointerId);
    if (!finger) return;
    const [dx, dy] = [e.clientX - finger.x, e.clientY - finger.y];
    moved += Math.abs(dx) + Math.abs(dy);
    if (fingers.size === 2) {
      const before = spread();
      Object.assign(finger, { x: e.clientX, y: e.clientY });
      const after = spread();
      pan(after.x - before.x, after.y - before.y);
      zoom(before.apart / after.apart);
      return;
    }
    Object.assign(finger, { x: e.clientX, y: e.clientY });
    if (e.shiftKey || e.ctrlKey || (e.buttons & 6)) pan(dx, dy);
    else turn(dx, dy);
  });
  const lift = (e) => {
    if (e.type === "pointerup" && fingers.has(e.pointerId) && moved < 4) ask(e);
    fingers.delete(e.pointerId);
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  // Until the view has been clicked the wheel scrolls the page.
  canvas.addEventListener("wheel", (e) => {
    if (document.activeElement !== canvas) return;
    e.preventDefault();
    zoom(Math.exp((e.deltaMode ? 16 : 1) * Math.max(-200, Math.min(200, e.deltaY)) * 0.0015));
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    if (e.altKey || e.ctrlKey || e.metaKey) return;
    const step = 24, move = e.shiftKey ? pan : turn;
    const keys = {
      ArrowLeft: () => move(-step, 0), ArrowRight: () => move(step, 0), ArrowUp: () => move(0, -step), ArrowDown: () => move(0, step),
      "+": () => zoom(0.85), "=": () => zoom(0.85), "-": () => zoom(1 / 0.85), "0": () => look(HOME), Home: () => look(HOME),
      t: () => look(ABOVE), f: () => look(FRONT),
    };
    const action = keys[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (action) {
      e.preventDefault();
      action();
    }
  });

  // What lies under the pointer: the nearest triangle the ray meets.
  const ask = (e) => {
    const frame = canvas.getBoundingClientRect();
    const tan = Math.tan(FIELD / 2);
    const x = (2 * (e.clientX - frame.left) / frame.width - 1) * tan * aspect(), y = (1 - 2 * (e.clientY - frame.top) / frame.height) * tan;
    const { right, up, ahead } = basis();
    const from = eye(ahead), ray = ahead.map((a, i) => a + right[i] * x + up[i] * y);
    let best = null;
    const hit = (name, skip) => {
      const m = meshes[name];
      if (!m) return;
      const corner = (i) => [m.position[3 * i], m.position[3 * i + 1], m.position[3 * i + 2] * camera.height];
      for (let t = 0; t < m.index.length; t += 3) {
        const [i, j, k] = [m.index[t], m.index[t + 1], m.index[t + 2]];
        const a = corner(i), u = less(corner(j), a), v = less(corner(k), a);
        const normal = cross(u, v), slope = dot(normal, ray);
        if (!slope) continue;
        const away = dot(normal, less(a, from)) / slope;
        if (!(away > 0) || (best && away >= best.away)) continue;
        const p = from.map((f, n) => f + ray[n] * away);
        const q = less(p, a), square = dot(normal, normal);
        const b = dot(cross(q, v), normal) / square, c = dot(cross(u, q), normal) / square;
        if (b < 0 || c < 0 || b + c > 1 || (skip && skip(p))) continue;
        const value = m.value ? m.value[i] * (1 - b - c) + m.value[j] * b + m.value[k] * c : null;
        best = { away, p, name, value };
      }
    };
    if (show.works) ["works", "bare"].forEach((name) => hit(name));
    const shown = best;
    // The ground under or over the works is not drawn.
    if (show.ground) hit("ground", show.works ? (p) => shown && Math.hypot(p[0] - shown.p[0], p[1] - shown.p[1]) < size * 0.02 : null);
    if (!best) {
      readout.textContent = "";
      return;
    }
    const at = best.p.map((v, i) => v / (i === 2 ? camera.height : 1) + scene.origin[i]);
    let text = `E ${at[0].toFixed(2)}  N ${at[1].toFixed(2)}  elevation ${at[2].toFixed(2)} ${scene.unit}`;
    if (best.name === "ground") text += " · existing ground";
    else if (scene.onGround && best.name === "works") {
      text += best.value < 0 ? ` · cut ${(-best.value).toFixed(2)} ${scene.unit}` : ` · fill ${best.value.toFixed(2)} ${scene.unit}`;
    }
    readout.textContent = text;
  };

  for (const [name, view] of [["home", HOME], ["above", ABOVE], ["front", FRONT]]) part(name).addEventListener("click", () => look(view));
  part("height").addEventListener("change", (e) => {
    const before = camera.height;
    camera.height = Number(e.target.value) || 1;
    camera.target[2] *= camera.height / before;
    if (kept) look(kept);
    else redraw();
  });
  for (const name of Object.keys(show)) {
    const input = part(`show-${name}`);
    if (!input) continue;
    input.checked = show[name];
    input.addEventListener("change", () => {
      show[name] = input.checked;
      redraw();
    });
  }

  const start = () => {
    try {
      prepare();
    } catch (error) {
      state("unavailable", "The 3D view could not be set up on this device. Plan, profile and sections show the same works.");
      return;
    }
    redraw();
  };
  gl = canvas.getContext("webgl2", { antialias: true, alpha: false, preserveDrawingBuffer: true });
  if (!gl) {
    state("unavailable", "This browser offers no WebGL 2, so there is no 3D view. Plan, profile and sections show the same works.");
    return;
  }
  part("stage").hidden = false;
  canvas.addEventListener("webglcontextlost", (e) => {
    e.preventDefault();
    state("lost", "The graphics card was taken away; the view comes back when it does.");
  });
  canvas.addEventListener("webglcontextrestored", start);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  // Paper is white, whatever the screen is. Browsers print the last picture shown, so the one for paper goes into a plain canvas.
  const still = part("still");
  const printing = (on) => {
    paper = on;
    document.documentElement.classList.toggle("printing", on);
    if (kept) look(kept);
    paint();
    if (!on) return;
    [still.width, still.height] = [canvas.width, canvas.height];
    still.getContext("2d").drawImage(canvas, 0, 0);
  };
  window.addEventListener("beforeprint", () => printing(true));
  window.addEventListener("afterprint", () => printing(false));
  matchMedia("print").addEventListener("change", (e) => printing(e.matches));
  new ResizeObserver(() => {
    if (!canvas.clientWidth) return;
    if (kept) look(kept);
    else redraw();
  }).observe(canvas);
  start();
  look(HOME);
})();
