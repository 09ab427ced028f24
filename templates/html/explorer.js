// Motions with sliders: a point is drawn through the plane of initial angular velocities, and the
// body turns as R(t) says, on the hyperbola in elementary functions, off it in elliptic ones; the
// motion to come is a faint line. Numbers are doubles; certified digits come from the command that
// is shown. The state stands in the address, so that a link shows a motion. Without this script
// nothing is shown.
"use strict";
((root) => {
  const { atlasFormulas: formulas, atlasLooks: looks } = root;
  const NEARNESS = 1e-8, // of Carlson's arguments to their mean, whose square is the error
    BESIDE = 1e-7; // of a momentum along the axis to that along the field, beside |B'|
  const norm = (...a) => Math.hypot(...a);
  const add = (a, b, s = 1) => a.map((x, i) => x + s * b[i]),
    inner = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

  // The constants of the motion at omega2 on the hyperbola, for B2 > 0: (71), (79), (72), and the
  // square of the frequency of small nutations, negative where the motion is unstable.
  const motion = (...curve) => {
    const [k, phi] = formulas.frequencies(...curve);
    return { omega3: formulas.ordinate(...curve), k, phi, stability: formulas.stability(...curve) };
  };
  // The turn about a unit vector, row by row; R(t) = R_B(kt) R_z(phi t), (84).
  const turn = ([x, y, z], angle) => {
    const c = Math.cos(angle), s = Math.sin(angle), h = 2 * Math.sin(angle / 2) ** 2;
    return [[c + h * x * x, h * x * y - s * z, h * x * z + s * y], [
      h * y * x + s * z,
      c + h * y * y,
      h * y * z - s * x,
    ], [h * z * x - s * y, h * z * y + s * x, c + h * z * z]];
  };
  const product = (A, B) =>
    A.map((row) => [0, 1, 2].map((j) => row[0] * B[0][j] + row[1] * B[1][j] + row[2] * B[2][j]));
  const rotation = (B2, B3, k, phi, t) =>
    product(turn([0, B2 / norm(B2, B3), B3 / norm(B2, B3)], k * t), turn([0, 0, 1], phi * t));
  // The quadric (50) of constant Omega3 about its centre -B', as the upper triangle of its form in
  // y = omega + B' and 1, its axis e'_2, at beta/2 + pi/4 from e2, (53), and e'_3.
  const quadric = (I, B2, B3) => {
    const at = (y1, y2, y3) => formulas.residual(I, B2, B3, y1, y2 - B2, y3 - B3);
    const constant = at(0, 0, 0), [a, b, c] = [at(1, 0, 0), at(0, 1, 0), at(0, 0, 1)];
    const [first, second, third] = [a, b, c].map((value) => value - constant);
    const mixed = (at(0, 1, 1) - constant - second - third) / 2;
    const [cosine, sine] = formulas.halfAngle(I, B2, B3);
    return {
      form: [first, 0, 0, 0, second, mixed, 0, third, 0, constant],
      axis: [0, cosine, sine],
      other: [0, -sine, cosine],
    };
  };
  const kind = (I) => I > 1 ? "two-sheet hyperboloid" : I < 1 ? "one-sheet hyperboloid" : "cone";
  // The second component of the angular velocity with phi/k = p/q, theorem-closed.
  const closed = (I, B2, B3, p, q) => formulas.closing(I, B2, B3, p / q) * B2 / norm(B2, B3);
  // The real roots between two places of a polynomial, the constant coefficient first: between the
  // roots of its slope it has at most one, which is halved in as far as doubles go.
  const roots = (c, low, high) => {
    const value = (x) => c.reduceRight((sum, one) => sum * x + one, 0), HALVINGS = 80;
    if (c.length < 2) return [];
    const ends = [low, ...roots(c.slice(1).map((one, i) => (i + 1) * one), low, high), high];
    return ends.slice(1).flatMap((end, i) => {
      let [from, to] = [ends[i], end];
      const above = value(from) > 0;
      if (above === value(to) > 0) return [];
      for (let n = 0; n < HALVINGS; n += 1) {
        const middle = (from + to) / 2;
        if (above === value(middle) > 0) from = middle;
        else to = middle;
      }
      return [to];
    });
  };
  // The least and the largest Omega3 less that of the start, theorem-quartic: at the start the
  // square of its rate is positive, or it stands there at one end. None is beyond the poles, where
  // the axis is along B.
  const swing = (I, B2, B3, omega) => {
    const c = formulas.nutation(I, B2, B3, ...omega), b = norm(B2, B3), rests = !c[0];
    const rest = rests ? c.slice(1) : c, sense = rests ? Math.sign(rest[0]) : 0;
    if (rests && !sense) return [0, 0];
    const low = sense > 0 ? 0 : roots(rest, B3 - b, 0).at(-1) ?? B3 - b,
      high = sense < 0 ? 0 : roots(rest, 0, B3 + b)[0] ?? B3 + b;
    return [low, high];
  };
  const turning = (I, B2, B3, omega) => swing(I, B2, B3, omega).map((offset) => omega[2] + offset);
  // The square of dOmega3/dt at nu, the cosine between axis and field, of motions with the momenta
  // of this one and an energy h, with its own energy and c3 = Omega3 + b nu; and the potential,
  // theorem-top.
  const portrait = (I, B2, B3, [p, q, r]) => {
    const b = norm(B2, B3),
      M2 = q + B2,
      M3 = I * (r + B3),
      along = (M2 * B2 + M3 * B3) / b,
      A = (I - 1) * b * b;
    const V = (nu) => A * nu * nu + (along - M3 * nu) ** 2 / (1 - nu * nu),
      own = p * p + M2 * M2 + A * (B3 / b) ** 2;
    return {
      A,
      M3,
      along,
      b,
      c3: r + B3,
      own,
      V,
      squared: (nu, h) => b * b * (1 - nu * nu) * (h - V(nu)),
    };
  };
  // Carlson's integrals R_F of x, y, z and R_J of x, y, z and each pole, by duplication. The pair
  // y, z, real or conjugate, is given by its sum and product, a pole p with the root of
  // (p - x)(p - y)(p - z).
  const carlson = (x, sum, product, poles) => {
    let scale = 1, places = poles.map(([pole]) => pole), found = poles.map(() => 0);
    const apart = (value) => Math.abs(value - x) > NEARNESS * x;
    while (scale > 1e-40 && [sum / 2, Math.sqrt(product), ...places].some(apart)) {
      const root = Math.sqrt(x), pair = Math.sqrt(product), both = Math.sqrt(sum + 2 * pair);
      const lambda = root * both + pair;
      const terms = places.map((p, i) => {
        const size = (Math.sqrt(p) + root) * (p + Math.sqrt(p) * both + pair),
          slope = scale ** 1.5 * poles[i][1] / size;
        return 6 * scale / size * (slope > 1e-9 ? Math.atan(slope) / slope : 1);
      });
      found = found.map((value, i) => value + terms[i]);
      product = (product + lambda * (sum + lambda)) / 16;
      [x, sum, scale] = [(x + lambda) / 4, (sum + 2 * lambda) / 4, scale / 4];
      places = places.map((p) => (p + lambda) / 4);
    }
    const rest = places.map((p) => scale * ((x + sum + 2 * p) / 5) ** -1.5);
    return [((x + sum) / 3) ** -0.5, found.map((value, i) => value + rest[i])];
  };
  // Jacobi's amplitude of the parameter 1 - other, and its quarter period, by the arithmetic-
  // geometric mean; the parameter may be negative.
  const amplitude = (other) => {
    const ratios = [];
    let [a, b] = [1, Math.sqrt(other)];
    while (Math.abs(a - b) > 1e-15 * a && ratios.length < 40) {
      ratios.push((a - b) / (a + b));
      [a, b] = [(a + b) / 2, Math.sqrt(a * b)];
    }
    const at = (u) =>
      ratios.reduceRight(
        (angle, ratio) => (angle + Math.asin(ratio * Math.sin(angle))) / 2,
        2 ** ratios.length * a * u,
      );
    return { at, quarter: Math.PI / (2 * a) };
  };
  // The cosine nu between axis and field at a time, its rate, and the integrals of 1/(1 - nu) and
  // 1/(1 + nu) from a turning point nu0, where nu = nu0 + c/(P(t) - d) with Weierstrass's function
  // P, which at the other turning point nu1 is its root e: P = e + H cot^2(am/2).
  const nutating = ({ A, along, M3, own }, nu0, nu1) => {
    const square = 1 - nu0 * nu0, far = nu1 - nu0, momentum = along - M3 * nu0;
    const c = (M3 * momentum - nu0 * (own - A * nu0 * nu0 + A * square)) / 2;
    const second = -(own + A + M3 * M3), e = A * nu0 * nu0 / 2 + second / 12 + c / far;
    const invariant = A * (own - along * along) + second * second / 12,
      H = Math.sqrt(Math.max(3 * e * e - invariant / 4, 1e-24 * e * e)),
      { at, quarter } = amplitude(Math.max(0.5 + 0.75 * e / H, 1e-15)),
      period = 2 * quarter / Math.sqrt(H);
    // 1 - side nu at a turning point; there the square of the rate is zero, which tells it near 0
    const lacking = (side, nu) =>
      side * nu > 0.9
        ? (along - M3 * nu) ** 2 / ((own - A * nu * nu) * (1 + side * nu))
        : 1 - side * nu;
    const sides = [1, -1].map((side) => {
      const gap = lacking(side, nu0);
      return {
        gap,
        weight: side * c / gap / 3,
        pole: c * lacking(side, nu1) / (far * gap),
        root: Math.abs((along - side * M3) * c) / (2 * gap * gap),
      };
    });
    const from = (x) =>
      carlson(
        x,
        2 * x + 3 * e,
        x * x + 3 * e * x + H * H,
        sides.map(({ pole, root }) => [x + pole, root]),
      );
    const half = from(0)[1], whole = sides.map((_, i) => 2 * half[i]);
    const state = (time) => {
      const turns = Math.round(time / period), left = time - turns * period;
      const angle = at(2 * Math.sqrt(H) * Math.abs(left)) / 2;
      const x = H / Math.max(Math.tan(angle) ** 2, 1e-60), shift = x + c / far;
      const parts = from(x)[1].map((part, i) => turns * whole[i] + Math.sign(left) * part);
      return {
        nu: nu0 + c / shift,
        slope: 2 * c * Math.sign(left) *
          Math.sqrt(x * (x * x + 3 * e * x + H * H)) / (shift * shift),
        parts: sides.map(({ gap, weight }, i) => (time + weight * parts[i]) / gap),
      };
    };
    // the time from nu0 to a place between, by what lacks to nu1
    const reached = (less) => from(c * less / ((far - less) * far))[0];
    return { state, reached };
  };
  // Omega(t), R(t) and dOmega3/dt of any motion: turns by psi about the field, by theta between
  // field and axis, and by chi about the axis, whose rates are rational in nu, theorem-top.
  const course = (I, B2, B3, omega) => {
    const { b, c3, ...constants } = portrait(I, B2, B3, omega), { along, M3 } = constants;
    // an axis through the pole, where psi and chi are not told apart, is drawn beside it
    if (Math.abs(Math.abs(along) - Math.abs(M3)) < BESIDE * b) {
      return course(I, B2, B3, add(omega, [0, 2 * BESIDE * norm(B2, B3) / B2 * b, 0]));
    }
    const [low, high] = swing(I, B2, B3, omega), nu = B3 / b, ends = [-low / b, -high / b];
    const [far, near] = Math.abs(low) > Math.abs(high) ? ends : ends.toReversed();
    let at = (t) => ({ nu, slope: 0, parts: [t / (1 - nu), t / (1 + nu)] }), start = 0;
    if (far !== near) {
      const { state, reached } = nutating(constants, nu + far, nu + near);
      start = (B2 * omega[0] * (near - far) > 0 ? -1 : 1) * reached(near);
      at = state;
    }
    const begun = at(start).parts, level = [[1, 0, 0], [0, nu, B2 / b], [0, -B2 / b, nu]];
    return (t) => {
      const { nu, slope, parts } = at(start + t), sine = Math.sqrt(Math.max(1 - nu * nu, 1e-30));
      const [up, down] = parts.map((part, i) => (part - begun[i]) / 2);
      const psi = (along - M3) * up + (along + M3) * down - b * t,
        chi = (c3 - M3) * t - (along - M3) * up + (along + M3) * down;
      const precession = (along - M3 * nu) / (sine * sine) - b, nutation = -slope / sine;
      const [cosine, across] = [Math.cos(chi), Math.sin(chi)];
      const tilt = [[1, 0, 0], [0, nu, -sine], [0, sine, nu]];
      return {
        omega: [
          precession * sine * across + nutation * cosine,
          precession * sine * cosine - nutation * across,
          c3 - b * nu,
        ],
        R: [turn([0, 0, 1], psi), tilt, turn([0, 0, 1], chi)].reduce(product, level),
        rate: -b * slope,
      };
    };
  };
  const OFF = 40 * Math.PI / 180,
    SIZE = 300,
    LEFT = 34,
    TOP = 10,
    FRAME = 256,
    WIDE = [-3, 3, "ω₂"],
    HIGH = [-5, 5, "ω₃"],
    FAR = 1e6,
    SEARCHED = 0.2, // of omega2 on each side: more than what counts as near
    FINE = 50,
    NARROWER = 20,
    ROUNDS = 4;
  // The omega2 of the point of the hyperbola that is nearest to a point of the plane, and how far
  // that is in pixels.
  const beside = (I, B2, B3, [omega2, omega3]) => {
    const gap = (w) => {
      const far = norm(
        FRAME * (w - omega2) / (WIDE[1] - WIDE[0]),
        FRAME * (motion(I, B2, B3, w).omega3 - omega3) / (HIGH[1] - HIGH[0]),
      );
      return far < FAR ? far : FAR; // also at the pole
    };
    // where the curve is as high as the point, which a step over omega2 may miss beside the pole
    const half = (I * B2 * omega3 - (2 - I) * B2 * B3) / 2,
      root = Math.sqrt(half * half + I * B2 * B2 * omega3 * B3);
    let [best] = [omega2, (half + root) / B3, (half - root) / B3].sort((v, w) => gap(v) - gap(w)),
      reach = SEARCHED;
    for (let round = 0; round < ROUNDS; round += 1, reach /= NARROWER) {
      const middle = best;
      for (let i = -FINE; i <= FINE; i += 1) {
        const w = middle + reach * i / FINE;
        if (gap(w) < gap(best)) best = w;
      }
    }
    return [best, gap(best)];
  };
  root.atlasMotion = {
    motion,
    rotation,
    quadric,
    kind,
    closed,
    course,
    portrait,
    beside,
    turning,
  };
  if (!root.document || !root.atlasViewer) return;

  const SCALE = 0.11,
    TRACE_STEP = 0.1, // radians, of which the corners are a tenth of a pixel
    MOST_STEPS = 1500,
    REACH = 0.42,
    TEXTS = [["e₁", 12], ["e₂", 12], ["e₃", 12], ["B′", 13], ["ω", 10], ["B", 9], ["R₃", 15]];
  const frame = (azimuth, elevation) => {
    const [a, e] = [azimuth, elevation].map((x) => x * Math.PI / 180),
      [ca, sa, ce, se] = [Math.cos(a), Math.sin(a), Math.cos(e), Math.sin(e)];
    return [-sa, ca, 0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se];
  };
  // Lines, arrows and dots look as their roles do in the figures.
  const colour = (role) => looks[role][0];
  const stroke = (role, points) => [...looks[role].slice(0, 2), points];
  const dot = (role, point) => [...looks[role].slice(0, 2), point];
  const arrow = (role, tail, tip) => {
    const [ink, tube] = looks[role];
    return [ink, tube, 5 + tube, 0.3 * (5 + tube), tail, tip];
  };
  const surface = (role, form, planes, reach) => {
    const [front, , back, glass] = looks[role];
    return [form, planes, [], front, back, glass, Array(3).fill(-reach), Array(3).fill(reach)];
  };
  const sampled = (low, high, count, f) =>
    Array.from({ length: count + 1 }, (_, i) => f(low + (high - low) * i / count));
  const circle = (middle, a, b, radius, from = 0, to = 2 * Math.PI) =>
    Array.from({ length: 73 }, (_, i) => {
      const w = from + (to - from) * i / 72;
      return middle.map((x, j) => x + radius * (Math.cos(w) * a[j] + Math.sin(w) * b[j]));
    });
  const empty = (azimuth, elevation) => ({
    frame: frame(azimuth, elevation),
    matt: 0,
    surfaces: [],
    lines: [],
    wires: [],
    arrows: [],
    dots: [],
    names: [],
  });

  // In the space of initial data: the quadric about its centre, the hyperbola, and the point on it.
  const space = ({ I, B2, B3, omega }) => {
    const panel = empty(25, 14),
      { form, axis, other } = quadric(I, B2, B3),
      at = (omega) => omega.map((x, i) => SCALE * (x + [0, B2, B3][i])),
      size = Math.max(...form.map(Math.abs), 1e-9);
    const scaled = form.map((x, i) => (i === 9 ? x * SCALE * SCALE : x) / size),
      value = (y) => {
        const [a, , , , b, c] = scaled;
        return a * y[0] ** 2 + b * y[1] ** 2 + 2 * c * y[1] * y[2];
      };
    const top = axis.map((x) => REACH * x),
      across = (d) => Math.sqrt(Math.max(0, -(value(top) + scaled[9]) / value(d))),
      rim = [across([1, 0, 0]), across(other)],
      box = Math.max(REACH, ...rim) + 0.1;
    const planes = [...axis, REACH, ...axis.map((x) => -x), REACH];
    panel.surfaces.push(surface("surface", scaled, planes, box));
    for (const side of [1, -1]) {
      panel.lines.push(stroke(
        "rim",
        Array.from({ length: 73 }, (_, i) => {
          const w = Math.PI * i / 36;
          return [
            rim[0] * Math.cos(w),
            side * top[1] + rim[1] * Math.sin(w) * other[1],
            side * top[2] + rim[1] * Math.sin(w) * other[2],
          ];
        }),
      ));
    }
    let run = [];
    const flush = () => {
      if (run.length > 2) panel.lines.push(stroke("hyperbola", run));
      run = [];
    };
    for (let i = 1; i < 400; i++) { // the two branches, by the angle seen from the pole
      const w = -B2 + B2 * Math.tan(Math.PI * (i / 400 - 0.5)),
        y = at([0, w, motion(I, B2, B3, w).omega3]);
      if (i === 200 || !y.every(Number.isFinite) || Math.abs(inner(axis, y)) > REACH) flush();
      else run.push(y);
    }
    flush();
    const O = at([0, 0, 0]), point = at(omega);
    [0, 1, 2].forEach((i) => {
      const tip = O.map((x, j) => x + (i === j ? 0.3 : 0));
      panel.arrows.push(arrow("basis", O, tip));
      panel.names.push([i, colour("basis"), tip, O]);
    });
    panel.arrows.push(arrow("field", O, at([0, B2, B3])));
    panel.names.push([3, colour("field"), at([0, B2, B3]), O]);
    if (norm(...point) < 1.2) {
      panel.arrows.push(arrow("velocity", O, point));
      panel.dots.push(dot("unstable_point", point));
      panel.names.push([4, colour("velocity"), point, O]);
    }
    panel.dots.push(dot("centre", [0, 0, 0]));
    return panel;
  };
  // In space: a cylindrical shell with this I, its axis, and the trace of that over a span of time,
  // gone by and to come.
  const body = ({ I, B2, B3, at, span, fast }, t) => {
    const panel = empty(20, 15),
      R = at(t),
      [a, b, n] = [0, 1, 2].map((j) => R.map((row) => row[j])),
      less = n.map((x) => -x);
    const h = Math.sqrt(12 * Math.max(1 / I - 0.5, 0)),
      r = 0.34 / norm(1, h / 2),
      half = Math.max(r * h / 2, 0.012);
    const P = (i, j) => (i === j ? 1 : 0) - n[i] * n[j],
      side = [P(0, 0), P(0, 1), P(0, 2), 0, P(1, 1), P(1, 2), 0, P(2, 2), 0, -r * r],
      ends = [...n, half, ...less, half],
      wedge = (s) => [...add(b.map((x) => s * x), a, -0.25), 0];
    panel.surfaces.push(
      surface("solid", side, ends, 0.6),
      surface("seam", side.slice(), [...ends, ...wedge(1), ...wedge(-1)], 0.6),
    );
    for (const s of [1, -1]) {
      panel.lines.push(stroke("rim", circle(n.map((x) => s * half * x), a, b, r)));
    }
    const B = [0, B2 / norm(B2, B3), B3 / norm(B2, B3)],
      gone = Math.min(t, span),
      rod = 0.46,
      trace = (from, to) =>
        sampled(
          from,
          to,
          Math.min(MOST_STEPS, Math.ceil((to - from) * fast / TRACE_STEP) + 1),
          (s) => at(s).map((row) => rod * row[2]),
        );
    panel.lines.push(["#b9c7e2", 1.6, trace(t, t + span)]); // what is to come is paler
    if (gone) panel.lines.push(stroke("trace", trace(t - gone, t)));
    panel.arrows.push(
      arrow("body_axis", [0, 0, 0], n.map((x) => rod * x)),
      arrow("field", [0, 0, 0], B.map((x) => 0.5 * x)),
    );
    panel.names.push([5, colour("field"), B.map((x) => 0.5 * x), [0, 0, 0]], [
      6,
      colour("body_axis"),
      n.map((x) => rod * x),
      [
        0,
        0,
        0,
      ],
    ]);
    return panel;
  };

  const SVG = "http://www.w3.org/2000/svg";
  const node = (tag, attributes, ...inside) => {
    const made = document.createElementNS(SVG, tag);
    Object.entries(attributes).forEach(([name, value]) => made.setAttribute(name, value));
    made.append(...inside);
    return made;
  };
  // The names of a panel, as letters of the page; those that are there stay.
  const write = (panel) => {
    const { names } = panel.data;
    if (panel.letters.length === names.length && panel.letters[0].querySelector("text")) return;
    panel.letters.forEach((one) => one.remove());
    panel.letters = names.map(([number, colour]) => {
      const [letters, width] = TEXTS[number],
        text = node("text", {
          fill: colour,
          "font-size": 176,
          "font-weight": 700,
          "text-anchor": "middle",
          y: 60,
        }, letters);
      const made = node("svg", {
        viewBox: [-width / 2 - 3, -9, width + 6, 18].map((x) => 16 * x).join(" "),
      }, text);
      panel.viewer.letters.append(made);
      return made;
    });
  };

  // What is drawn in a plane: {x, y: [low, high, letters], lines: [class, points], dots: [class, x,
  // y], words: [x, y, letters]}.
  const places = (
    { x, y },
  ) => [
    (v) => LEFT + FRAME * (v - x[0]) / (x[1] - x[0]),
    (v) => TOP + FRAME * (y[1] - v) / (y[1] - y[0]),
  ];
  const paint = (svg, drawn) => {
    const { x, y, lines = [], dots = [], words = [] } = drawn,
      [X, Y] = places(drawn),
      far = (v) => !(Math.abs(v) < 3 * SIZE),
      n = (v) => v.toFixed(1),
      square = { x: LEFT, y: TOP, width: FRAME, height: FRAME };
    const path = (points) =>
      points.reduce(
        ([d, pen], [u, v]) =>
          far(X(u)) || far(Y(v)) ? [d, "M"] : [`${d}${pen}${n(X(u))} ${n(Y(v))}`, "L"],
        ["", "M"],
      )[0];
    const ticks = ([low, high]) => {
      const step = [0.2, 0.5, 1, 2].find((one) => (high - low) / one <= 8) ?? 5,
        first = Math.ceil(low / step - 1e-9);
      return Array.from(
        { length: Math.floor(high / step + 1e-9) - first + 1 },
        (_, i) => Number(((first + i) * step).toFixed(1)),
      );
    };
    const text = (u, v, letters, anchor = "start", kind = "") =>
      node(
        "text",
        { x: n(u), y: n(v), "text-anchor": anchor, class: kind },
        String(letters).replace("-", "−"),
      );
    svg.replaceChildren(
      node("rect", square),
      ...ticks(x).map((v) => text(X(v), SIZE - 18, v, "middle")),
      ...ticks(y).map((v) => text(LEFT - 5, Y(v) + 4, v, "end")),
      node(
        "svg",
        { ...square, viewBox: Object.values(square).join(" ") },
        ...lines.map(([kind, points]) => node("path", { class: kind, d: path(points) })),
        ...words.map(([u, v, letters, kind]) => text(X(u) + 7, Y(v) - 7, letters, "start", kind)),
        ...dots.filter(([, u, v]) => !far(X(u)) && !far(Y(v))).map(([kind, u, v]) =>
          node("circle", { class: kind, cx: n(X(u)), cy: n(Y(v)), r: kind === "point" ? 7 : 4 })
        ),
      ),
      text(LEFT + FRAME, SIZE - 3, x[2], "end", "axis"),
      text(LEFT + 7, TOP + 16, y[2], "start", "axis"),
    );
  };
  // Lines of f over omega2, the stable motions and the unstable ones.
  const over = ({ I, B2, B3 }, f) =>
    [["curve", (m) => m.stability > 0], ["unstable", (m) => !(m.stability > 0)]].map((
      [kind, holds],
    ) => [
      kind,
      sampled(...WIDE.slice(0, 2), 900, (w) => {
        const m = motion(I, B2, B3, w);
        return [w, holds(m) && Math.abs(w + B2) > 1e-9 ? f(m) : NaN];
      }),
    ]);
  const PLANES = {
    plane: (state) => {
      const { B2, B3, omega } = state;
      return {
        x: WIDE,
        y: HIGH,
        lines: [
          ["guide", [[-3, 0], [3, 0]]],
          ["guide", [[0, -5], [0, 5]]],
          ...over(state, (m) => m.omega3),
        ],
        dots: [["pole", -B2, -B3], ["rest", 0, 0], ["point", omega[1], omega[2]]],
        words: [[-B2, -B3, "−B′", "pole"], [0, -0.95, "rest"]],
      };
    },
    frequencies: (state) => {
      const { I, B2, B3, omega } = state,
        m = motion(I, B2, B3, omega[1]),
        nutation = (m) => Math.sqrt(Math.max(m.stability, 0)),
        kinds = [["k", "second", (m) => m.k], ["ϕ", "main", (m) => m.phi], [
          "νₙ",
          "third",
          nutation,
        ]];
      return {
        x: WIDE,
        y: [-6, 6, "1/time"],
        lines: [
          ["guide", [[-3, 0], [3, 0]]],
          ["guide", [[omega[1], -6], [omega[1], 6]]],
          ...kinds.map((
            [, kind, f],
          ) => [
            kind,
            sampled(
              -3,
              3,
              900,
              (w) => [w, Math.abs(w + B2) > 4e-3 ? f(motion(I, B2, B3, w)) : NaN],
            ),
          ]),
        ],
        dots: kinds.map(([, kind, f]) => [kind, omega[1], f(m)]),
        words: kinds.map(([name, kind, f]) => [omega[1], f(m), name, kind]),
      };
    },
    portrait: ({ I, B2, B3, omega, state }, t) => {
      const { b, c3, own, V, squared } = portrait(I, B2, B3, omega),
        all = sampled(-0.999, 0.999, 600, (nu) => nu),
        heights = all.map(V),
        low = Math.min(...heights),
        humps = heights.filter((v, i) => i && v > heights[i - 1] && v >= heights[i + 1]);
      const span = Math.max(own - low, ...humps.map((h) => h - low), 0.1 * b * b),
        moment = state(t),
        top = 1.25 * Math.sqrt(Math.max(...all.map((nu) => squared(nu, low + 1.3 * span)), 1e-4));
      // Where the square changes its sign between two places, the curve ends on the axis.
      const line = (kind, h) =>
        [1, -1].map((sign) => [
          kind,
          all.flatMap((nu, i) => {
            const before = all[Math.max(i - 1, 0)],
              [u, v] = [squared(before, h), squared(nu, h)],
              here = [c3 - b * nu, sign * Math.sqrt(v)];
            return u * v < 0 ? [[c3 - b * (nu - (nu - before) * v / (v - u)), 0], here] : [here];
          }),
        ]);
      const wide = all.filter((nu) => squared(nu, low + 1.3 * span) >= 0).map((nu) => c3 - b * nu),
        [left, right] = [Math.min(...wide) - 0.1, Math.max(...wide) + 0.1];
      return {
        x: [left, right, "Ω₃"],
        y: [-top, top, "dΩ₃/dt"],
        lines: [
          ["guide", [[left, 0], [right, 0]]],
          ...[0.04, 0.16, 0.36, 0.64, 1, 1.3].flatMap((part) => line("level", low + part * span)),
          ...humps.flatMap((h) => line("unstable", h)),
          ...line("curve", own + 1e-9),
        ],
        dots: [["point", moment.omega[2], moment.rate]],
      };
    },
    rosette: ({ B2, B3, at, span }, t) => {
      const b = norm(B2, B3),
        flat = (s) => {
          const [x, y, z] = at(s).map((row) => Math.sin(OFF) * row[0] + Math.cos(OFF) * row[2]);
          return [x, (B3 * y - B2 * z) / b, (B2 * y + B3 * z) / b];
        },
        way = sampled(0, span, 1500, flat),
        part = (side) => way.map(([x, y, z]) => z * side >= 0 ? [x, y] : [NaN, NaN]);
      return {
        x: [-1.1, 1.1, "across B"],
        y: [-1.1, 1.1, ""],
        lines: [["guide", sampled(0, 2 * Math.PI, 90, (w) => [Math.cos(w), Math.sin(w)])], [
          "level",
          part(-1),
        ], ["trace", part(1)]],
        dots: [["point", ...flat(t % span).slice(0, 2)]],
      };
    },
  };
  const SPACES = { space, body };
  const DIGITS = (x) =>
      Number.isFinite(x) ? String(Number(x.toPrecision(6))).replace("-", "−") : "none, at the pole",
    NEAR = 5, // pixels
    AHEAD = 12,
    SLIDE = 1400; // milliseconds

  for (const [number, section] of document.querySelectorAll(".explorer").entries()) {
    const form = section.querySelector("form"),
      out = section.querySelector("output"),
      line = section.querySelector("form + p code, output + p code"),
      box = section.querySelector(".stage"),
      calm = matchMedia("(prefers-reduced-motion: reduce)"),
      mark = `#motion${number || ""}:`;
    const [first, second] = section.dataset.field.split(" ").map(Number),
      b = norm(first, second),
      shown = section.dataset.panels.split(" "),
      flat = [...section.querySelectorAll(".plane")];
    const value = (name, other = 0) => sliders.find(name)?.value ?? other;
    let seen = false, free = false, viewer, kept = {}, sliding = 0;
    const place = () => {
      const I = value("I", 1.5),
        angle = sliders.find("angle"),
        still = !angle || angle.value === angle.start,
        [B2, B3] = still
          ? [first, second]
          : [Math.cos, Math.sin].map((f) => b * f(angle.value * Math.PI / 180));
      const omega2 = sliders.find("q")
        ? closed(I, B2, B3, value("p"), value("q"))
        : value("omega2");
      return { I, B2, B3, omega2, ...motion(I, B2, B3, omega2) };
    };
    const state = () => {
      const { I, B2, B3, omega2, omega3, k, phi, stability } = place(),
        omega = [value("omega1"), omega2, free ? value("omega3") : omega3],
        key = [I, B2, B3, ...omega].join(" ");
      if (kept.key === key) return kept;
      const field = `--ratio ${I} --field ${Number(B2.toPrecision(12))} ${
          Number(B3.toPrecision(12))
        }`,
        on = !free && !omega[0],
        spin = Number.isFinite(phi) ? phi : 0,
        moved = course(I, B2, B3, omega.map((x) => Number.isFinite(x) ? x : 0));
      if (on) {
        return kept = {
          key,
          I,
          B2,
          B3,
          omega,
          on,
          state: moved,
          at: (t) => rotation(B2, B3, k, spin, t),
          span: 2 * Math.PI * value("q", 1) / Math.abs(k || 1),
          fast: Math.abs(k),
          says: `${kind(I)}; ω₂ = ${DIGITS(omega2)}, ω₃ = ${DIGITS(omega3)}, k = ${
            DIGITS(k)
          }, ϕ = ${DIGITS(phi)}; ${stability > 0 ? "stable" : "unstable"}`,
          command: `atlas motion ${field} --omega2 ${omega2}`,
        };
      }
      const [low, high] = turning(I, B2, B3, omega).map(DIGITS);
      return kept = {
        key,
        I,
        B2,
        B3,
        omega,
        on,
        state: moved,
        at: (t) => moved(t).R,
        span: AHEAD,
        fast: norm(omega[0], omega[1], Math.sqrt(I) * omega[2]), // the axis never goes faster, by (36)
        says: `off the hyperbola: the axis nutates, Ω₃ swings from ${low} to ${high}`,
        command: `atlas motion ${field} --omega ${omega.join(" ")}`,
      };
    };
    // A point near the hyperbola is on it, and stays there while other sliders move.
    const follow = () => {
      if (!free && Number.isFinite(place().omega3)) {
        sliders.find("omega3")?.set(Number(place().omega3.toPrecision(7)));
      }
    };
    const settle = (near) => {
      const other = sliders.find("omega3");
      if (!other) return;
      const { I, B2, B3, omega2, omega3 } = place(),
        [nearest, gap] = beside(I, B2, B3, [omega2, other.value]);
      free = !(gap <= near);
      // on a steep part a point goes across to the curve, for along it may be far
      if (!free && !(Math.abs(omega3 - other.value) * FRAME / (HIGH[1] - HIGH[0]) <= near)) {
        sliders.find("omega2").set(Number(nearest.toPrecision(7)));
      }
      follow();
    };
    // The state that an address names; without omega3 the point is on the hyperbola.
    const read = (hash) => {
      if (!hash.startsWith(mark)) return;
      const parameters = new URLSearchParams(hash.slice(mark.length));
      sliders.read(parameters);
      if (parameters.has("omega3")) settle(1e-4);
      else {
        free = false;
        follow();
      }
    };
    const say = () => {
      const { says, command } = state();
      out.textContent = says;
      line.textContent = command;
    };
    const spaces = shown.filter((name) => name in SPACES),
      planes = shown.filter((name) => name in PLANES),
      made = (name) => SPACES[name](state(), value("t"));
    const film = section.classList.contains("film");
    if (film) spaces.length = 1; // the step says which
    const still = (name) => ["space", "plane", "frequencies"].includes(name);
    const show = (all) => {
      planes.forEach((name, i) => {
        if (all || !still(name)) paint(flat[i].firstChild, PLANES[name](state(), value("t")));
      });
      if (viewer) {
        spaces.forEach((name, i) => {
          if (all || !still(name)) viewer.panels[i].set(made(name));
        });
        viewer.hurry(sliders.playing && seen ? 1500 : 250);
      }
    };
    const changed = (name) => {
      if (!flat.concat(viewer ?? []).length) return;
      if (name !== "t") cancelAnimationFrame(sliding);
      if (name === "t") {
        show(false);
        return;
      }
      if (name === "omega3") settle(NEAR / 2);
      else follow();
      say();
      show(true);
    };
    const keep = () =>
      history.replaceState(null, "", `${mark}${new URLSearchParams(sliders.entries())}`);
    const sliders = new root.atlasSliders.Sliders(
      form,
      JSON.parse(form.dataset.sliders),
      changed,
      keep,
      () => seen,
    );
    if (form.dataset.free) free = true;
    else follow();
    read(location.hash);
    section.hidden = false;
    section.classList.add("live");
    planes.forEach((name, i) => {
      const drawn = node("svg", {
        viewBox: `0 0 ${SIZE} ${SIZE}`,
        role: "img",
        "aria-label": flat[i].dataset.says,
      });
      flat[i].append(drawn);
      if (name !== "plane" || !sliders.find("omega3")) return;
      const drag = ({ clientX, clientY }) => {
        const rect = drawn.getBoundingClientRect(),
          u = SIZE * (clientX - rect.left) / rect.width,
          v = SIZE * (clientY - rect.top) / rect.height,
          into = (x, [low, high]) => Math.round(100 * Math.min(high, Math.max(low, x))) / 100;
        sliders.find("omega2").set(into(WIDE[0] + (u - LEFT) * (WIDE[1] - WIDE[0]) / FRAME, WIDE));
        sliders.find("omega3").set(into(HIGH[1] - (v - TOP) * (HIGH[1] - HIGH[0]) / FRAME, HIGH));
        settle(NEAR);
        say();
        show(true);
      };
      drawn.addEventListener("pointerdown", (event) => {
        drawn.setPointerCapture(event.pointerId);
        cancelAnimationFrame(sliding);
        drag(event);
      });
      drawn.addEventListener("pointermove", (event) => {
        if (drawn.hasPointerCapture(event.pointerId)) drag(event);
      });
      drawn.addEventListener("pointerup", keep);
    });
    // The point slides to the motion of a step.
    const slide = ({ hash }) => {
      const wanted = new URLSearchParams(hash.slice(mark.length)),
        from = sliders.entries(),
        begun = performance.now(),
        was = free;
      cancelAnimationFrame(sliding);
      const frame = (clock) => {
        const share = calm.matches ? 1 : Math.min((clock - begun) / SLIDE, 1);
        if (share >= 1) {
          read(hash);
          say();
        } else {
          const part = share * share * (3 - 2 * share), at = new Map();
          for (const [name, start] of from) {
            const end = wanted.has(name) ? Number(wanted.get(name)) : start;
            if (name !== "t") at.set(name, start + part * (end - start));
          }
          sliders.read(at);
          free = was || wanted.has("omega3");
          if (was && !wanted.has("omega3")) {
            const start = new Map(from).get("omega3");
            sliders.find("omega3").set(start + part * (place().omega3 - start));
          }
          follow();
          sliding = requestAnimationFrame(frame);
        }
        show(true);
      };
      frame(begun);
    };
    // The step that comes to the middle of what the scene leaves free is shown.
    const scroll = () => {
      const steps = [...section.querySelectorAll(".steps > li")];
      const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
      const line = Math.round(65 * Math.min(1, (50 * rem) / innerHeight)); // in % of a window of at most 50rem
      let now = location.hash.startsWith(mark) ? steps[0] : null; // an address stands till one scrolls
      const watch = new IntersectionObserver((entries) => {
        const step = entries.find((one) => one.isIntersecting)?.target;
        if (!step || step === now) return;
        now = step;
        spaces[0] = step.dataset.panel;
        slide(step.querySelector("a"));
      }, { rootMargin: `${-line}% 0px ${line - 99}% 0px` });
      steps.forEach((step) => watch.observe(step));
    };
    const share = 1 / spaces.length,
      wide = film && box.clientWidth < 1.2 * box.clientHeight ? 300 : 450, // a telephone's is square
      layout = () =>
        spaces.map((_, i) => [
          i * share,
          0,
          share,
          1,
          wide * share,
          300,
          spaces.length > 1 ? 215 : 300,
          wide * share / 2,
          150,
        ]);
    if (spaces.length) {
      try {
        const scene = box.appendChild(document.createElement("div"));
        scene.className = "scene";
        viewer = new root.atlasViewer.Viewer(scene, {
          wide: { places: layout(), panels: spaces.map(made) },
          texts: TEXTS.map(([letters, width]) => [width, 12, "", letters]),
        }, box.dataset.says);
        for (const panel of viewer.panels) {
          panel.write = () => write(panel);
          panel.write();
        }
      } catch (error) {
        box.hidden = true;
        console.warn(error.message);
      }
    }
    say();
    show(true);
    if (sliders.time) {
      sliders.go(!calm.matches);
      calm.addEventListener("change", () => sliders.go(!calm.matches));
    }
    addEventListener("hashchange", () => {
      read(location.hash);
      say();
      show(true);
    });
    if (film) scroll();
    new IntersectionObserver(([{ isIntersecting }]) => {
      seen = isIntersecting;
      if (seen && sliders.time) sliders.go(sliders.playing);
    }).observe(section);
  }
})(globalThis);
