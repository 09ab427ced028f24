// Scenes that turn: a click or Enter on a still picture puts the scene over it, in which lines are
// ribbons that face the eye and every surface is a piece of a quadric that is met by a ray through
// each pixel, so that outlines and the order of glass are exact. Names are placed anew at each
// turn. Only the scene's own file is asked for, by a script element; without WebGL 2 the still
// stays.
"use strict";
(() => {
  // The light falls as in the shaded pictures: direction and strength of each lamp; they do not
  // turn.
  const LAMPS = [[-0.55, 0.75, 0.9, 0.9], [0.9, 0.15, 0.8, 0.26], [0.1, 1, -0.5, 0.25], [
    0,
    -0.35,
    1,
    0.2,
  ]]
    .flatMap(([x, y, z, strength]) => [...unit([x, y, z]), strength]);
  const REACH = 2,
    STEPS = 16000,
    GRID = 16,
    PIECE = 11,
    FORMS = [1, 2, 3, 6, 16],
    PIECES = [1, 2, 4, 16],
    MOST = 16,
    TILE = 24;

  const HEAD =
    "#version 300 es\nprecision highp float; precision highp int; precision highp sampler2D;\n";
  // Depth is linear in the distance to the eye: REACH in front of the middle is 0, REACH behind it
  // 1.
  const SOLID_VERTEX = `${HEAD}in vec3 point, normal; in vec4 tint; uniform mat3 F; uniform vec4 M;
uniform float more; out vec3 n, b, c;
void main() { vec3 q = F * (point + more * normal); n = F * normal; b = vec3(0); c = tint.rgb;
gl_Position = vec4(M.xy + M.zw * q.xy, -q.z / ${REACH}.0, 1); }`;
  const SOLID_FRAGMENT = `${HEAD}in vec3 n, b, c; uniform vec4 L[4]; out vec4 o;
void main() { vec3 m = normalize(n + b * sqrt(max(1.0 - dot(n, n), 0.0))); float d = 0.3, s = 0.0;
  for (int i = 0; i < 4; i++) { d += 0.72 * L[i].w * max(dot(m, L[i].xyz), 0.0);
s += 0.35 * L[i].w * pow(max(reflect(-L[i].xyz, m).z, 0.0), 30.0); }
  o = vec4(min(c * d + s, 1.0), 1); }`;
  // A line is a ribbon that faces the eye, shaded as a tube, as wide as a pixel at least and as
  // near as the tube; a wire is painted on its surface, and the fainter.
  const LINE_VERTEX =
    `${HEAD}in vec3 point, way; in float side, radius; in vec4 tint; uniform mat3 F;
uniform vec4 M; uniform float least, lift; out vec3 n, b, c;
void main() { vec3 q = F * point, w = F * way, p = vec3(-w.y, w.x, 0) / max(length(w.xy), 1e-9);
float r = max(radius, least); n = side * p; b = normalize(cross(w, p)); c = tint.rgb;
  gl_Position = vec4(M.xy + M.zw * (q + r * n).xy, -(q.z + lift * r) / ${REACH}.0, 1); }`;
  // Along x + t d, with d to the eye, F = A t^2 + 2 B t + C: a ray meets each quadric twice, and
  // what it meets is laid over what is behind. For speed without a graphics card few pieces are
  // written one after the other, and a condition is a loop that ends at once. What is opaque stands
  // among the solids.
  const FULL_VERTEX =
    `${HEAD}in vec2 at; out vec2 P; void main() { P = at; gl_Position = vec4(at, 0, 1); }`;
  const times = (count, text) => Array.from({ length: count }, (_, i) => text(i)).join("\n");
  const piece = (k) =>
    `{
bool on = all(lessThanEqual(D[${k} + 9].xyz, y)) && all(lessThanEqual(y, D[${k} + 10].xyz)) ${
      times(4, (i) => `&& dot(D[${k} + ${i}].xyz, y) <= D[${k} + ${i}].w + 1e-5`)
    };
for (bool now = on && D[${k} + 6].z > 0.0; now; now = false) on = dot(form(D[${k} + 4],
D[${k} + 5], D[${k} + 6], v), v) <= 1e-6;
front = on ? D[${k} + 7] : front; back = on ? D[${k} + 8] : back; }`;
  const cast = (
    sets,
    opaque,
    forms = sets.length,
    start = (f) => PIECE * sets.slice(0, f).reduce((a, b) => a + b, 0),
  ) =>
    `${HEAD}in vec2 P; out vec4 o; uniform highp sampler2D wire, depth; uniform mat3 F;
uniform vec4 M, L[4], thread, Q[${3 * forms}], D[${
      start(forms)
    }]; uniform float texel; uniform bool matt;
vec4 form(vec4 a, vec4 b, vec4 c, vec4 v) {
return vec4(dot(a, v), dot(vec4(a.y, b.xyz), v), dot(vec4(a.z, b.y, b.w, c.x), v), dot(vec4(a.w,
b.z, c.xy), v));
}
vec4 shade(vec3 n, vec3 tint, float clear, float off) {
float light = matt ? 0.72 : 0.66, glare = 0.0, shine = matt ? 0.0 : 0.28;
${
      times(4, (i) =>
        `{ light += (matt ? 0.34 : 0.46) * L[${i}].w * max(dot(n, L[${i}].xyz), 0.0);
float m = max(reflect(-L[${i}].xyz, n).z, 0.0); m *= m; m *= m; m *= m;
glare += shine * L[${i}].w * m * m * m * m * m; }`)
    }
float dense = clear >= 1.0 ? 1.0 : clear + (0.94 - clear) * pow(1.0 - clamp(n.z, 0.0, 1.0), 2.2);
float line = off < texel * (1.5 + 1.5 * sqrt(1.0 - n.z * n.z) / max(n.z, 0.1)) ? thread.a : 0.0,
all = 1.0 - (1.0 - dense) * (1.0 - line);
return vec4((thread.rgb * line + min(tint * light + glare, 1.0) * dense * (1.0 - line)) / all, all);
}
void main() {
ivec2 at = ivec2(gl_FragCoord.xy); float zw = 9.0, z = ${
      opaque ? "-9.0" : `${REACH}.0 * (1.0 - 2.0 * texelFetch(depth, at, 0).r)`
    };
for (bool now = thread.a > 0.0; now; now = false) zw = ${REACH}.0 * (1.0 - 2.0 *
texelFetch(wire, at, 0).r);
mat3 T = transpose(F); vec3 d = T[2], x = T * vec3((P - M.xy) / M.zw, 0);
${times(2 * forms, (m) => `float t${m} = 9.0; vec4 p${m} = vec4(0);`)}
${
      sets.map((pieces, f) =>
        `{
vec4 a = Q[${3 * f}], b = Q[${3 * f + 1}], c = Q[${
          3 * f + 2
        }], Qd = form(a, b, c, vec4(d, 0)), Qx = form(a, b, c, vec4(x, 1));
float A = dot(Qd.xyz, d), B = dot(Qd, vec4(x, 1)), C = dot(Qx, vec4(x, 1)), S = B * B - A * C,
r = -(B + (B < 0.0 ? -1.0 : 1.0) * sqrt(max(S, 0.0)));
for (int j = S > 0.0 ? 0 : 2; j < 2; j++) {
float t = j == 0 ? C / r : abs(A) > 1e-7 ? r / A : 9.0; vec3 y = x + t * d;
vec4 front = vec4(0), back = front, v = vec4(y, 1);
${
          pieces > 4
            ? `for (int k = ${start(f)}; k < ${start(f + 1)} && D[k + 7].a > 0.0; k += ${PIECE}) ${
              piece("k")
            }`
            : times(pieces, (p) => piece(start(f) + PIECE * p))
        }
for (bool keep = front.a > 0.0 && t > z && abs(t) < ${REACH}.0; keep; keep = false) {
vec3 g = form(a, b, c, v).xyz; bool outer = dot(g, d) > 0.0;
vec4 h = shade(F * normalize(outer ? g : -g), outer ? front.rgb : back.rgb, front.a, abs(t - zw));
${
          times(2 * f + 2, (m) =>
            `{ bool less = t < t${m}; float u = less ? t${m} : t; vec4 w = less ? p${m} : h;
t${m} = less ? t : t${m}; p${m} = less ? h : p${m}; t = u; h = w; }`)
        }
}
}
}`
      ).join("\n")
    }
${
      opaque
        ? `if (t0 > 8.0) discard;
bool two = t1 < 8.0;
o = two ? p1 : p0;
gl_FragDepth = 0.5 - 0.5 * (two ? t1 : t0) / ${REACH}.0;`
        : `vec4 c = vec4(0); ${
          times(2 * forms, (m) => `c = c * (1.0 - p${m}.a) + vec4(p${m}.rgb, 1) * p${m}.a;`)
        } o = c;`
    }
}`;

  function unit(a) {
    const size = Math.hypot(...a) || 1;
    return a.map((x) => x / size);
  }
  const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (
    a,
    b,
  ) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const across = (a) => unit(cross(a, Math.abs(a[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]));
  const rgb = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  // A line's points, or 16-bit numbers in base 64.
  const points = (packed) => {
    if (Array.isArray(packed)) return packed;
    const steps = new Int16Array(
        Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0)).buffer,
      ),
      found = [];
    for (let i = 0; i < steps.length; i += 3) {
      found.push([steps[i] / STEPS, steps[i + 1] / STEPS, steps[i + 2] / STEPS]);
    }
    return found;
  };
  // While it moves: pixels to one of the page, no more than the screen has; what is coarser can't
  // be read.
  const SHARES = [0.5, 0.7, 1, 1.4, 2, 9];
  const headOf = ([, , head, , tail, tip], scale) => {
    const way = add(tip, tail, -1), size = Math.hypot(...way);
    return [
      add(tip, way, -Math.min(head / scale, 0.5 * size) / (size || 1)),
      Math.min(head / scale, 0.5 * size),
    ];
  };

  // Lines [colour, radius, points] as arrays of vertices and faces.
  const ribbons = (lines) => {
    const made = { point: [], way: [], side: [], radius: [], tint: [] }, faces = [];
    for (const [colour, radius, line] of lines) {
      const tint = [...rgb(colour), 255];
      line.forEach((x, i) => {
        const way = add(line[Math.min(i + 1, line.length - 1)], line[Math.max(i - 1, 0)], -1),
          at = made.side.length;
        made.point.push(...x, ...x);
        made.way.push(...way, ...way);
        made.side.push(-1, 1);
        made.radius.push(radius, radius);
        made.tint.push(...tint, ...tint);
        if (i) faces.push(at - 2, at - 1, at, at - 1, at + 1, at);
      });
    }
    return [{
      point: [3, made.point],
      way: [3, made.way],
      side: [1, made.side],
      radius: [1, made.radius],
      tint: [4, made.tint, true],
    }, faces];
  };
  // Meshes of rings about an axis a: [centre, radius, slope of the normal].
  class Mesh {
    points = [];
    normals = [];
    tints = [];
    faces = [];
    rings(rings, a, colour, sides) {
      const first = this.points.length / 3,
        tint = [...rgb(colour), 255],
        u = across(a),
        v = cross(a, u);
      rings.forEach(([centre, radius, slope], k) => {
        for (let i = 0; i < sides; i++) {
          const turn = 2 * Math.PI * i / sides,
            n = add(u.map((x) => x * Math.cos(turn)), v, Math.sin(turn));
          this.points.push(...add(centre, n, radius));
          this.normals.push(...unit(add(n, a, slope)));
          this.tints.push(...tint);
          if (k) {
            const p = first + (k - 1) * sides, q = p + (i + 1) % sides;
            this.faces.push(p + i, q, p + sides + i, q, q + sides, p + sides + i);
          }
        }
      });
    }
    ball(centre, radius, colour) {
      const axis = [0, 0, 1],
        rings = Array.from({ length: 9 }, (_, k) => {
          const w = Math.PI * (k / 8 - 0.5) * 0.999;
          return [add(centre, axis, radius * Math.sin(w)), radius * Math.cos(w), Math.tan(w)];
        });
      this.rings(rings, axis, colour, 14);
    }
    arrow(arrow, scale) {
      const [colour, , head, broad, tail, tip] = arrow, [base, size] = headOf(arrow, scale);
      if (!size) return;
      const a = unit(add(tip, tail, -1)), radius = broad / head * size;
      this.rings([[base, 0, -99], [base, radius, -99]], a, colour, 18);
      this.rings([[base, radius, radius / size], [tip, 0, radius / size]], a, colour, 18);
    }
  }

  // Where names may stand, and at what cost, as in the stills.
  const TURNS = [0, 20, -20, 40, -40, 65, -65, 90, -90, 120, -120, 150, -150, 180].map((turn) =>
    turn * Math.PI / 180
  );
  const PLACES = TURNS.flatMap((turn) =>
    [0, 3, 7, 12].map((step) => [turn, step, 1.6 * Math.abs(turn) + 0.35 * step])
  );

  class Panel {
    constructor(viewer, number) {
      Object.assign(this, { viewer, number, kept: [], letters: [] });
      this.set(viewer.shown.panels[number]);
      this.home = this.data.frame;
      this.frame = this.home.slice();
    }
    // Shows other contents; what turned stays turned.
    set(data) {
      this.data = data;
      if (this.solid) this.load();
    }
    get place() {
      const [left, top, width, height, W, H, scale, x, y] = this.viewer.shown.places[this.number];
      return { left, top, width, height, W, H, scale, shift: [x, y] };
    }
    load() {
      const { data } = this, { scale } = this.place, mesh = new Mesh();
      const unpacked = (all) =>
          all.map(([colour, tube, packed]) => [colour, tube / scale / 2, points(packed)]),
        lines = unpacked(data.lines),
        shafts = data.arrows.map(
          (arrow) => [arrow[0], arrow[1] / scale / 2, [arrow[4], headOf(arrow, scale)[0]]],
        );
      for (const arrow of data.arrows) mesh.arrow(arrow, scale);
      for (const [colour, tube, at] of data.dots) mesh.ball(at, tube / scale / 2, colour);
      this.solid = this.viewer.vertices(this.solid, this.viewer.solid, {
        point: [3, mesh.points],
        normal: [3, mesh.normals],
        tint: [4, mesh.tints, true],
      }, mesh.faces);
      this.line = this.viewer.vertices(
        this.line,
        this.viewer.line,
        ...ribbons([...lines, ...shafts]),
      );
      this.wire = this.viewer.vertices(
        this.wire,
        this.viewer.wire,
        ...ribbons(unpacked(data.wires)),
      );
      const forms = new Map(), tint = (colour) => rgb(colour).map((x) => x / 255);
      this.pieces = data.surfaces.map(([form, planes, [within], front, back, dense, low, high]) => {
        if (!forms.has(String(form))) forms.set(String(form), [...form, 0, 0]);
        const clip = [...planes, ...Array(4).fill([0, 0, 0, 1]).flat()].slice(0, 16);
        return {
          form: forms.get(String(form)),
          low,
          high,
          opaque: dense >= 1,
          numbers: [
            ...clip,
            ...(within ? [...within, 1, 0] : Array(12).fill(0)),
            ...tint(front),
            dense,
            ...tint(back),
            0,
            ...low,
            0,
            ...high,
            0,
          ],
        };
      });
      this.ink = [];
      const all = lines.reduce((sum, [, , line]) => sum + line.length, 0),
        every = Math.max(1, Math.ceil(all / 600));
      for (const [, , line] of lines) {
        for (let i = 0; i < line.length; i += every) this.ink.push([line[i], 1.5]);
      }
      for (const [, , , , tail, tip] of data.arrows) {
        for (let i = 0; i <= 8; i++) this.ink.push([add(tail, add(tip, tail, -1), i / 8), 2]);
      }
      for (const [, , at] of data.dots) this.ink.push([at, 8]);
      this.write();
    }
    write() {
      this.letters.forEach((one) => one.remove());
      this.letters = this.data.names.map(([text, colour]) => {
        const [wide, high, outline] = this.viewer.data.texts[text],
          made = svg("svg", {
            viewBox: [-wide / 2 - 3, -high / 2 - 3, wide + 6, high + 6].map((x) => GRID * x).join(
              " ",
            ),
          });
        made.append(svg("path", { d: outline, fill: colour }));
        this.viewer.letters.append(made);
        return made;
      });
    }
    turn(right, up) { // about e3, then about what points to the right
      const f = this.frame, c = Math.cos(right), s = Math.sin(right);
      const [r, u, t] = [0, 3, 6].map(
        (i) => [c * f[i] + s * f[i + 1], c * f[i + 1] - s * f[i], f[i + 2]],
      );
      this.frame = [
        ...r,
        ...add(u.map((x) => x * Math.cos(up)), t, -Math.sin(up)),
        ...add(t.map((x) => x * Math.cos(up)), u, Math.sin(up)),
      ];
    }
    // Lower left corner and size in pixels; from the scene to -1..1; pixels to a point.
    measure(width, height) {
      const { left, top, width: w, height: h, W, H, scale, shift } = this.place,
        { zoom, move } = this.viewer;
      const box = [left * width, (1 - top - h) * height, w * width, h * height].map(Math.round),
        fit = box[2] / W;
      const at = [0, 1].map((i) => {
        const span = [W, H][i];
        return 2 * ((shift[i] - span / 2) * zoom + move[i]) / span;
      });
      return { box, fit, M: [...at, 2 * scale * zoom / W, 2 * scale * zoom / H] };
    }
    names(width, height) {
      const { box: [x0, , , h], fit, M } = this.measure(width, height),
        { W, H, top } = this.place,
        f = this.frame,
        { texts } = this.viewer.data;
      const flat = (p) => [
        (M[0] + M[2] * dot(f.slice(0, 3), p) + 1) * W / 2,
        (M[1] + M[3] * dot(f.slice(3, 6), p) + 1) * H / 2,
      ];
      const ink = this.ink.map(([p, weight]) => [...flat(p), weight]), taken = [];
      this.data.names.forEach(([text, , places, stands], number) => {
        const [wide, high] = texts[text], [a, b] = [wide / 2, high / 2];
        let offset = stands, best;
        if (stands.length === 3) {
          const tail = flat(stands),
            tip = flat(places),
            size = Math.hypot(tip[0] - tail[0], tip[1] - tail[1]) || 1;
          offset = [4.5 * (tip[0] - tail[0]) / size + 1e-9, 4.5 * (tip[1] - tail[1]) / size];
        }
        const length = Math.hypot(...offset), angle = Math.atan2(offset[1], offset[0]);
        for (let k = 0; k < places.length; k += 3) {
          const [px, py] = flat(places.slice(k, k + 3));
          for (const [j, [turn, step, price]] of (length ? PLACES : PLACES.slice(0, 1)).entries()) {
            const u = Math.cos(angle + turn),
              v = Math.sin(angle + turn),
              reach = length &&
                length + step + Math.min(a / Math.abs(u), b / Math.abs(v), Math.hypot(a, b));
            const x = px + reach * u, y = py + reach * v, key = 100 * k + j;
            let cost = price + 0.3 * k - (this.kept[number] === key ? 1.5 : 0) +
              40 *
                (Math.max(0, a - x) + Math.max(0, x + a - W) + Math.max(0, b - y) +
                  Math.max(0, y + b - H));
            if (cost >= best?.cost) continue;
            for (const [ix, iy, weight] of ink) {
              if (Math.abs(ix - x) < a + 1.2 && Math.abs(iy - y) < b + 1.2) cost += weight;
            }
            for (const [tx, ty, ta, tb] of taken) {
              const over = [ta + a + 5.2 - Math.abs(tx - x), tb + b + 2.2 - Math.abs(ty - y)];
              if (over[0] > 0 && over[1] > 0) cost += 30 + over[0] * over[1];
            }
            if (!best || cost < best.cost) best = { cost, x, y, key };
          }
        }
        this.kept[number] = best.key;
        taken.push([best.x, best.y, a, b]);
        const { style } = this.letters[number], size = [wide + 6, high + 6].map((x) => fit * x);
        style.width = `${size[0]}px`;
        style.height = `${size[1]}px`;
        style.transform = `translate(${(x0 + fit * best.x - size[0] / 2).toFixed(1)}px,${
          (top * height + h - fit * best.y - size[1] / 2).toFixed(1)
        }px)`;
      });
    }
  }

  const svg = (tag, attributes) => {
    const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
    Object.entries(attributes).forEach((pair) => made.setAttribute(...pair));
    return made;
  };

  class Viewer {
    constructor(box, data, says, narrow) {
      const shown = narrow && data.narrow ? { ...data.wide, ...data.narrow } : data.wide;
      Object.assign(this, { box, data, shown, zoom: 1, move: [0, 0], pace: 1 });
      const canvas = this.canvas = document.createElement("canvas");
      canvas.tabIndex = 0;
      canvas.role = "application";
      canvas.ariaLabel = says;
      const gl = this.gl = canvas.getContext("webgl2", { antialias: false });
      if (!gl) throw new Error("no WebGL 2");
      this.letters = document.createElement("div");
      this.letters.ariaHidden = "true";
      this.solid = this.program(SOLID_VERTEX, SOLID_FRAGMENT);
      this.line = this.program(LINE_VERTEX, SOLID_FRAGMENT);
      this.wire = this.program(LINE_VERTEX, `${HEAD}void main() {}`);
      this.panels = shown.panels.map((_, number) => new Panel(this, number));
      this.panels.forEach((panel) => panel.load());
      this.full = {};
      box.append(canvas, this.letters);
      this.listen();
      this.seen = new ResizeObserver(() => this.hurry());
      this.seen.observe(box);
    }
    program(vertex, fragment) {
      const { gl } = this, program = gl.createProgram();
      [vertex, fragment].forEach((text, i) => {
        const shader = gl.createShader(i ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER);
        gl.shaderSource(shader, text);
        gl.compileShader(shader);
        gl.attachShader(program, shader);
      });
      gl.linkProgram(program);
      if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
        throw new Error(gl.getProgramInfoLog(program));
      }
      const places = new Map();
      return {
        program,
        at: (name) => {
          if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
          return places.get(name);
        },
      };
    }
    vertices(old, by, parts, faces) {
      const { gl } = this, made = old ?? { array: gl.createVertexArray(), buffers: {}, by };
      gl.bindVertexArray(made.array);
      made.count = faces.length;
      for (const [name, [size, numbers, bytes]] of Object.entries(parts)) {
        const at = gl.getAttribLocation(by.program, name);
        if (at < 0) continue;
        const buffer = made.buffers[name] ??= gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(
          gl.ARRAY_BUFFER,
          bytes ? new Uint8Array(numbers) : new Float32Array(numbers),
          gl.DYNAMIC_DRAW,
        );
        gl.enableVertexAttribArray(at);
        gl.vertexAttribPointer(at, size, bytes ? gl.UNSIGNED_BYTE : gl.FLOAT, Boolean(bytes), 0, 0);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, made.buffers[""] ??= gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint32Array(faces), gl.DYNAMIC_DRAW);
      return made;
    }
    target(width, height) {
      const { gl, canvas } = this;
      if (this.solids && canvas.width === width && canvas.height === height) return;
      canvas.width = width;
      canvas.height = height;
      const { FRAMEBUFFER, TEXTURE_2D, NEAREST } = gl,
        texture = (kind, place) => {
          const made = gl.createTexture();
          gl.bindTexture(TEXTURE_2D, made);
          gl.texStorage2D(TEXTURE_2D, 1, kind, width, height);
          for (const which of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
            gl.texParameteri(
              TEXTURE_2D,
              which,
              NEAREST,
            );
          }
          gl.framebufferTexture2D(FRAMEBUFFER, place, TEXTURE_2D, made, 0);
          return made;
        };
      const frame = (old, coloured) => {
        if (old) {
          gl.deleteFramebuffer(old.frame);
          gl.deleteTexture(old.colour || null);
          gl.deleteTexture(old.depth);
        }
        const made = { frame: gl.createFramebuffer() };
        gl.bindFramebuffer(FRAMEBUFFER, made.frame);
        made.depth = texture(gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT);
        made.colour = coloured && texture(gl.RGBA8, gl.COLOR_ATTACHMENT0);
        return made;
      };
      this.solids = frame(this.solids, true);
      this.wires = frame(this.wires);
    }
    draw(fine = true) {
      const { box } = this, { clientWidth, clientHeight } = box;
      if (!clientWidth || !clientHeight) return;
      const sharp = devicePixelRatio,
        ratio = fine
          ? Math.min(
            2 * sharp,
            Math.max(1, Math.sqrt(4e5 * 2 ** this.pace / clientWidth / clientHeight)),
          )
          : Math.min(sharp, SHARES[this.pace]);
      const width = Math.round(clientWidth * ratio), height = Math.round(clientHeight * ratio);
      this.target(width, height);
      for (const panel of this.panels) this.drawPanel(panel, width, height);
      for (const panel of this.panels) panel.names(clientWidth, clientHeight);
    }
    // The program for quadrics with so many pieces each.
    caster(sets, opaque) {
      const key = `${sets} ${opaque}`;
      return this.full[key] ??= this.vertices(null, this.program(FULL_VERTEX, cast(sets, opaque)), {
        at: [2, [-1, -1, 3, -1, -1, 3]],
      }, [0, 1, 2]);
    }
    drawPanel(panel, width, height) {
      const { gl } = this,
        { box: [left, low, w, h], fit, M } = panel.measure(width, height),
        f = panel.frame,
        F = [f[0], f[3], f[6], f[1], f[4], f[7], f[2], f[5], f[8]],
        thread = [0, 0, 0, 0],
        texel = 2 / (M[2] * w);
      let now;
      const mesh = (count) => gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, 0),
        begin = (frame) => {
          gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
          gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        };
      const use = (one) => {
        if (one === now) return;
        now = one;
        gl.useProgram(one.by.program);
        gl.bindVertexArray(one.array);
        gl.uniformMatrix3fv(one.by.at("F"), false, F);
        gl.uniform4fv(one.by.at("M"), M);
        gl.uniform4fv(one.by.at("L"), LAMPS);
      };
      const draw = (one, lift) => {
        use(one);
        gl.uniform1f(one.by.at("least"), texel / 2);
        gl.uniform1f(one.by.at("lift"), lift);
        mesh(one.count);
      };
      const rays = (list, edges, opaque) => { // where -1..1 is the panel
        const sets = [...new Set(list.map((one) => one.form))].map((form) =>
          list.filter((one) => one.form === form)
        ).sort((a, b) => b.length - a.length);
        const sizes = Array.from(
            { length: FORMS.find((n) => n >= sets.length) },
            (_, i) => PIECES.find((n) => n >= (sets[i] ?? []).length),
          ),
          full = this.caster(sizes, opaque),
          { at } = full.by,
          fill = (numbers, size) => new Float32Array(size).map((_, i) => numbers[i] ?? 0);
        use(full);
        gl.uniform1i(at("depth"), 1);
        gl.uniform4fv(at("thread"), thread);
        gl.uniform1i(at("matt"), panel.data.matt);
        gl.uniform1f(at("texel"), texel);
        gl.uniform4fv(at("Q"), fill(sets.flatMap((set) => set[0].form), 12 * sizes.length));
        gl.uniform4fv(
          at("D"),
          sets.flatMap((set, i) => [...fill(
            set.flatMap((one) => one.numbers),
            4 * PIECE * sizes[i],
          )]),
        );
        const [a, b, c, e] = edges.map((x, i) =>
          Math.round(Math.min(1, Math.max(0, (x + 1) / 2)) * [w, h][i % 2])
        );
        gl.scissor(left + a, low + b, c - a, e - b);
        mesh(3);
      };
      for (const one of panel.pieces) {
        one.span = [9, 9, -9, -9];
        for (let k = 0; k < 8; k++) {
          const p = [0, 1, 2].map((i) => (k >> i & 1 ? one.low : one.high)[i]);
          [0, 1].forEach((i) => {
            const u = M[i] + M[2 + i] * dot(f.slice(3 * i, 3 * i + 3), p);
            one.span[i] = Math.min(one.span[i], u);
            one.span[2 + i] = Math.max(one.span[2 + i], u);
          });
        }
      }
      gl.enable(gl.SCISSOR_TEST);
      gl.viewport(left, low, w, h);
      gl.scissor(left, low, w, h);
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
      gl.disable(gl.BLEND);
      gl.clearColor(1, 1, 1, 1);
      [this.wires.depth, this.solids.depth].forEach((texture, i) => {
        gl.activeTexture(gl.TEXTURE0 + i);
        gl.bindTexture(gl.TEXTURE_2D, i ? null : texture);
      });
      if (panel.wire.count) {
        const [colour, tube] = panel.data.wires[0], thick = tube * fit * this.zoom;
        rgb(colour).forEach((x, i) => {
          thread[i] = x / 255;
        });
        thread[3] = Math.min(1, thick);
        begin(this.wires.frame);
        draw(panel.wire, 0);
      }
      begin(this.solids.frame);
      use(panel.solid);
      gl.uniform1f(panel.solid.by.at("more"), Math.max(0, (texel - 1 / panel.place.scale) / 2));
      mesh(panel.solid.count);
      draw(panel.line, 1);
      for (const one of panel.pieces) if (one.opaque) rays([one], one.span, true);
      gl.scissor(left, low, w, h);
      gl.disable(gl.DEPTH_TEST);
      gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.solids.frame);
      gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
      gl.blitFramebuffer(
        left,
        low,
        left + w,
        low + h,
        left,
        low,
        left + w,
        low + h,
        gl.COLOR_BUFFER_BIT,
        gl.NEAREST,
      );
      gl.bindFramebuffer(gl.FRAMEBUFFER, null);
      gl.bindTexture(gl.TEXTURE_2D, this.solids.depth);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      // Glass tile by tile, each with the pieces whose boxes reach into it; a tile with many is
      // divided.
      const tile = (all, ...edges) => {
        const [x0, y0, x1, y1] = edges,
          list = all.filter(({ span }) =>
            span[0] < x1 && span[2] > x0 && span[1] < y1 && span[3] > y0
          ),
          x = (x0 + x1) / 2,
          y = (y0 + y1) / 2;
        if (list.length > 4 && (x1 - x0) * w > 2 * TILE) {
          for (const corner of [[x0, y0, x, y], [x, y0, x1, y], [x0, y, x, y1], [x, y, x1, y1]]) {
            tile(list, ...corner);
          }
        } else if (list.length) {
          rays(
            list.slice(0, MOST),
            edges.map((x, i) => {
              const all = list.map((one) => one.span[i]);
              return i < 2 ? Math.max(x, Math.min(...all)) : Math.min(x, Math.max(...all));
            }),
            false,
          );
        }
      };
      tile(panel.pieces.filter((one) => !one.opaque), -1, -1, 1, 1);
      gl.disable(gl.SCISSOR_TEST);
    }
    // While it moves it is drawn as coarsely as the time of a frame asks for.
    hurry(rest = 250) {
      clearTimeout(this.rest);
      this.rest = setTimeout(() => {
        cancelAnimationFrame(this.asked);
        this.asked = this.last = null;
        this.draw();
      }, rest);
      this.asked ??= requestAnimationFrame((now) => {
        this.asked = null;
        const took = this.last ? now - this.last : 30;
        this.last = now;
        this.slow = 0.7 * (this.slow ?? 30) + 0.3 * took;
        if (this.slow > 36 && this.pace) {
          this.pace--;
          this.slow = 30;
        } else if (this.slow < 20 && SHARES[this.pace] < devicePixelRatio) {
          this.pace++;
          this.slow = 30;
        }
        this.draw(false);
      });
    }
    turn(right, up) {
      this.panels.forEach((panel) => panel.turn(right, up));
      this.hurry();
    }
    scaleBy(factor) {
      this.zoom = Math.min(20, Math.max(0.2, this.zoom * factor));
      this.hurry();
    }
    shiftBy(x, y) {
      const { fit } = this.panels[0].measure(this.box.clientWidth, this.box.clientHeight);
      this.move = [this.move[0] + x / fit, this.move[1] - y / fit];
      this.hurry();
    }
    back() {
      this.panels.forEach((panel) => {
        panel.frame = panel.home.slice();
        panel.kept = [];
      });
      this.zoom = 1;
      this.move = [0, 0];
      this.hurry();
    }
    listen() {
      const { canvas } = this, down = new Map();
      canvas.addEventListener("pointerdown", (event) => {
        canvas.setPointerCapture(event.pointerId);
        down.set(event.pointerId, [event.clientX, event.clientY]);
      });
      canvas.addEventListener("pointermove", (event) => {
        if (!down.has(event.pointerId)) return;
        const [x, y] = down.get(event.pointerId), before = [...down.values()];
        down.set(event.pointerId, [event.clientX, event.clientY]);
        const dx = event.clientX - x,
          dy = event.clientY - y,
          now = [...down.values()],
          gap = ([[a, b], [c, d]]) => Math.hypot(a - c, b - d);
        if (down.size > 1) {
          this.scaleBy(gap(now) / (gap(before) || 1));
          this.shiftBy(dx / 2, dy / 2);
        } else if (event.shiftKey) this.shiftBy(dx, dy);
        else this.turn(0.008 * dx, 0.008 * dy);
      });
      canvas.addEventListener("lostpointercapture", (event) => down.delete(event.pointerId));
      canvas.addEventListener("wheel", (event) => {
        if (document.activeElement !== canvas) return;
        event.preventDefault();
        this.scaleBy(Math.exp(-0.0015 * event.deltaY));
      }, { passive: false });
      canvas.addEventListener("dblclick", () => this.back());
      const keys = {
        ArrowLeft: () => this.turn(-0.1, 0),
        ArrowRight: () => this.turn(0.1, 0),
        ArrowUp: () => this.turn(0, -0.1),
        ArrowDown: () => this.turn(0, 0.1),
        "+": () => this.scaleBy(1.1),
        "=": () => this.scaleBy(1.1),
        "-": () => this.scaleBy(1 / 1.1),
        "0": () => this.back(),
      };
      canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
      });
    }
    close() {
      clearTimeout(this.rest);
      cancelAnimationFrame(this.asked);
      this.seen.disconnect();
      this.gl.getExtension("WEBGL_lose_context")?.loseContext();
      this.box.remove();
    }
  }

  // The file of a scene calls atlasScene with it.
  const waiting = new Map();
  globalThis.atlasScene = (data) => waiting.get(document.currentScript)(data);
  const load = (file) =>
    new Promise((resolve, reject) => {
      const script = document.createElement("script");
      script.src = file;
      waiting.set(script, resolve);
      script.onerror = () => reject(new Error(`${file} can't be read`));
      document.head.append(script);
    });
  let able;
  const webgl = () => (able ??= Boolean(document.createElement("canvas").getContext("webgl2")));
  const open = async (link) => {
    const still = link.querySelector("img"),
      data = await load(link.dataset.scene),
      box = document.createElement("div"),
      close = document.createElement("button");
    box.className = "scene";
    link.parentElement.append(box);
    try {
      const viewer = new Viewer(
        box,
        data,
        `${still.alt} Arrow keys turn it, plus and minus zoom, 0 goes back, Escape closes it.`,
        still.currentSrc.includes("-narrow."),
      );
      const end = () => {
        viewer.close();
        link.removeAttribute("tabindex");
        link.focus();
      };
      close.textContent = "×";
      close.ariaLabel = "Back to the still picture";
      close.addEventListener("click", end);
      box.append(close);
      still.addEventListener("load", () => {
        if (box.isConnected) {
          end();
          open(link);
        }
      }, { once: true }); // of another width
      box.addEventListener("keydown", (event) => {
        if (event.key === "Escape") {
          event.stopPropagation();
          end();
        }
      });
      link.tabIndex = -1;
      viewer.hurry();
      viewer.canvas.focus({ preventScroll: true });
      link.viewer = viewer;
    } catch (error) {
      box.remove();
      throw error;
    }
  };
  for (const link of document.querySelectorAll("a[data-scene]")) {
    link.classList.add("turns");
    link.title = "Click or press Enter to turn it";
    const frame = document.createElement("div");
    frame.className = "turned";
    link.replaceWith(frame);
    frame.append(link);
    link.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey || !webgl()) return;
      event.preventDefault();
      open(link).catch((error) => console.warn(error.message));
    });
  }
  globalThis.atlasViewer = { Viewer, add, cross, dot, unit, load, open, points, webgl };
})();
