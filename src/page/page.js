'use strict';
// Everything is drawn anew from `state` by draw(); events only change the state.
(() => {
  const data = JSON.parse(document.getElementById('data').textContent);
  const $ = (id) => document.getElementById(id);
  const SIDE = 7, CELLS = 49;
  const FORWARD = [[1, 0], [0, 1], [-1, 0], [0, -1]];
  const ARROWS = ['→ right', '↓ down', '← left', '↑ up'];
  const RGB = {red: '#ff3b30', green: '#34c759', blue: '#3b7bff', purple: '#a855f7', yellow: '#facc15', grey: '#9ca3af'};
  const JOINS = ['and', 'then', 'after'];
  const state = {episodes: [], episode: null, step: 0, word: -1, cell: -1, overWord: -1, overCell: -1, filter: false,
    playing: null, follow: true};

  const bytes = (text) => Uint8Array.from(atob(text || ''), (c) => c.charCodeAt(0));
  const shares = (text) => Array.from(bytes(text), (b) => b / 255);
  const fixed = (x) => x === null || x === undefined ? '–' : x.toFixed(2).replace(/^(-?)0\./, '$1.');
  const escape = (text) => String(text).replace(/[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'}[c]));
  const sum = (numbers) => numbers.reduce((a, b) => a + b, 0);

  // ---- colors of shares: fixed from 0 to 1 on every map --------------------------------------------
  const RAMP = [[0, [24, 24, 32]], [.15, [59, 28, 90]], [.4, [160, 44, 100]], [.7, [240, 112, 60]], [1, [255, 224, 102]]];
  function heat(share) {
    let i = 1;
    while (i < RAMP.length - 1 && share > RAMP[i][0]) ++i;
    const [a, from] = RAMP[i - 1], [b, to] = RAMP[i];
    const t = Math.max(0, Math.min(1, (share - a) / (b - a)));
    return `rgb(${from.map((c, k) => Math.round(c + t * (to[k] - c))).join()})`;
  }
  const gradient = `linear-gradient(90deg, ${RAMP.map(([at]) => `${heat(at)} ${100 * at}%`).join()})`;

  // ---- tiles -----------------------------------------------------------------------------------------
  const TYPE = Object.fromEntries(data.types.map((name, i) => [name, i]));
  const colorOf = (c) => RGB[data.colors[c]] || '#888';
  function nameOf(type, color, doorState) {
    const name = data.types[type] || 'something';
    if (type === TYPE.unseen) return 'not seen';
    if (type <= TYPE.wall || type === TYPE.goal || type === TYPE.lava) return name;
    const how = type === TYPE.door ? ['open ', 'closed ', 'locked '][doorState] || '' : '';
    return `${how}${data.colors[color] || ''} ${name}`;
  }
  // A thing in the unit square.
  function glyph(type, color, doorState) {
    const c = colorOf(color);
    switch (data.types[type]) {
      case 'ball': return `<circle cx=".5" cy=".5" r=".3" fill="${c}"/>`;
      case 'box': return `<rect x=".18" y=".18" width=".64" height=".64" fill="none" stroke="${c}" stroke-width=".1"/>` +
        `<path d="M.18 .5H.82" stroke="${c}" stroke-width=".08"/>`;
      case 'key': return `<circle cx=".56" cy=".28" r=".14" fill="none" stroke="${c}" stroke-width=".1"/>` +
        `<path d="M.56 .42V.86M.56 .64H.38M.56 .8H.38" stroke="${c}" stroke-width=".1" fill="none"/>`;
      case 'door': return doorState === 0
        ? `<rect x=".84" y=".04" width=".12" height=".92" fill="none" stroke="${c}" stroke-width=".06"/>`
        : `<rect x=".06" y=".06" width=".88" height=".88" fill="${doorState === 2 ? c + '66' : 'none'}" stroke="${c}" stroke-width=".08"/>` +
          (doorState === 2 ? `<path d="M.6 .5H.8" stroke="${c}" stroke-width=".12"/>`
                           : `<circle cx=".74" cy=".5" r=".08" fill="none" stroke="${c}" stroke-width=".05"/>`);
      case 'goal': return '<rect width="1" height="1" fill="#34c759" opacity=".8"/>';
      case 'lava': return '<rect width="1" height="1" fill="#ff7a1a" opacity=".85"/>';
      case 'floor': return `<rect x=".05" y=".05" width=".9" height=".9" fill="${c}" opacity=".3"/>`;
      case 'wall': return '<rect width="1" height="1" fill="#7a7f8a"/>';
      default: return '';
    }
  }
  const agentGlyph = (direction) =>
    `<path d="M.16 .18L.86 .5L.16 .82Z" fill="#ff3b30" stroke="#fff" stroke-width=".05" transform="rotate(${90 * direction} .5 .5)"/>`;
  const placed = (x, y, inside, scale = 1) => inside &&
    `<g transform="translate(${x + (1 - scale) / 2} ${y + (1 - scale) / 2}) scale(${scale})">${inside}</g>`;
  const frame = (x, y, color, width = .1) =>
    `<rect x="${x + width / 2}" y="${y + width / 2}" width="${1 - width}" height="${1 - width}" fill="none" stroke="${color}" stroke-width="${width}"/>`;

  // ---- what a step says --------------------------------------------------------------------------------
  const steps = () => state.episode ? state.episode.steps : [];
  const now = () => steps()[state.step];
  const word = () => state.overWord >= 0 ? state.overWord : state.word;
  const cell = () => state.overCell >= 0 ? state.overCell : state.cell;
  const mapOf = (step, i) => shares(step.maps).slice(CELLS * i, CELLS * (i + 1));
  // A cell of the view in the world, and back.
  function inWorld(step, c) {
    const [ax, ay, d] = step.at, [fx, fy] = FORWARD[d];
    const ahead = 6 - c % SIDE, right = Math.floor(c / SIDE) - 3;
    return [ax + ahead * fx - right * fy, ay + ahead * fy + right * fx];
  }
  // The world at a step: the last one told, or what has been seen so far.
  function worldAt(episode, index) {
    for (let i = index; i >= 0; --i) {
      if (episode.steps[i].cells) return {size: episode.steps[i].size, cells: bytes(episode.steps[i].cells), whole: true};
    }
    const seen = new Map();
    let width = 1, height = 1;
    for (const step of episode.steps.slice(0, index + 1)) {
      if (step.at[0] < 0) continue;
      const image = bytes(step.image);
      for (let c = 0; c < CELLS; ++c) {
        const [x, y] = inWorld(step, c);
        if (image[3 * c] === TYPE.unseen || x < 0 || y < 0) continue;
        seen.set(`${x},${y}`, image.slice(3 * c, 3 * c + 3));
        width = Math.max(width, x + 1);
        height = Math.max(height, y + 1);
      }
    }
    const cells = new Uint8Array(3 * width * height);
    for (const [key, code] of seen) {
      const [x, y] = key.split(',').map(Number);
      cells.set(code, 3 * (x * height + y));
    }
    return {size: [width, height], cells, whole: false};
  }

  // ---- panels ----------------------------------------------------------------------------------------
  function drawWorld(step) {
    const {size: [width, height], cells, whole} = worldAt(state.episode, state.step);
    const [ax, ay, direction] = step.at;
    const image = bytes(step.image), lit = new Set();
    for (let c = 0; c < CELLS; ++c) if (image[3 * c] !== TYPE.unseen) lit.add(inWorld(step, c).join());
    let svg = '';
    for (let y = 0; y < height; ++y) {
      for (let x = 0; x < width; ++x) {
        const at = 3 * (x * height + y), type = cells[at];
        if (type === TYPE.unseen) continue;
        svg += `<rect x="${x}" y="${y}" width="1.01" height="1.01" fill="${lit.has(`${x},${y}`) ? '#3a3f4b' : '#16181d'}"/>`;
        svg += placed(x, y, glyph(type, cells[at + 1], cells[at + 2]));
      }
    }
    const path = steps().slice(0, state.step + 1).filter((s) => s.at[0] >= 0).map((s) => `${s.at[0] + .5},${s.at[1] + .5}`);
    if (path.length > 1) svg += `<polyline points="${path.join(' ')}" fill="none" stroke="#fff" stroke-opacity=".55" stroke-width=".09" stroke-dasharray=".16 .1"/>`;
    if (ax >= 0) svg += placed(ax, ay, agentGlyph(direction));
    for (const [x, y] of step.targets || []) svg += frame(x, y, '#f97316', .12);
    if (cell() >= 0 && ax >= 0) svg += frame(...inWorld(step, cell()), '#60a5fa', .1);
    $('world').innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${escape(describe(step))}" style="background:#0c0d10">${svg}</svg>`;
    const hand = step.carried && step.carried[0] > TYPE.empty ? `In its hand: ${nameOf(...step.carried)}. ` : '';
    $('world-note').textContent = hand + (whole ? 'Lighter: what the agent sees.' : ax >= 0 ? 'As far as it has been seen.' : 'Where the agent stands is not known.');
  }

  function viewTargets(step) {
    const targets = new Set((step.targets || []).map((t) => t.join()));
    return Array.from({length: CELLS}, (_, c) => targets.has(inWorld(step, c).join()));
  }

  // A 7x7 grid: background(c), things on top at a scale.
  function drawGrid(step, background, scale, label) {
    const image = bytes(step.image), targets = viewTargets(step);
    let svg = '';
    for (let c = 0; c < CELLS; ++c) {
      const x = Math.floor(c / SIDE), y = c % SIDE, type = image[3 * c];
      const thing = c === 27 && type === TYPE.empty ? '' : glyph(type, image[3 * c + 1], image[3 * c + 2]);
      const seen = type !== TYPE.unseen;
      svg += `<rect x="${x}" y="${y}" width="1" height="1" fill="${background(c, seen)}" stroke="#000" stroke-opacity=".35" stroke-width=".02"/>`;
      svg += placed(x, y, thing, scale(type)) || '';
      if (c === 27) svg += placed(x, y, agentGlyph(3), type > TYPE.empty ? .45 : scale(TYPE.agent));
      if (targets[c] && seen) svg += frame(x, y, '#f97316', .12);
      if (c === cell()) svg += placed(x, y, frame(0, 0, '#60a5fa', .12), .74);
    }
    for (let c = 0; c < CELLS; ++c) {
      const x = Math.floor(c / SIDE), y = c % SIDE;
      svg += `<rect class="cell" data-cell="${c}" x="${x}" y="${y}" width="1" height="1" fill="transparent"><title>${escape(cellText(step, c))}</title></rect>`;
    }
    return `<svg viewBox="0 0 7 7" role="img" aria-label="${escape(label)}">${svg}</svg>`;
  }

  function cellText(step, c) {
    const image = bytes(step.image);
    const what = nameOf(image[3 * c], image[3 * c + 1], image[3 * c + 2]);
    return step.gaze ? `${what}: ${fixed(shares(step.gaze)[c])} of M` : what;
  }

  function drawView(step) {
    $('view').innerHTML = drawGrid(step, (c, seen) => seen ? '#3a3f4b' : '#0c0d10', () => 1, `The view: ${seenThings(step)}`);
    $('view-note').textContent = `${step.at[2] === 3 ? 'Not turned' : 'Turned'}: up here is ${ARROWS[step.at[2]] || 'unknown'} in the world.`;
  }

  function currentMap(step) {
    const i = word();
    if (i >= 0 && step.maps) return {shares: mapOf(step, i), name: `Where “${state.episode.words[i]}” looks`, outside: true};
    if (state.filter && step.filter) return {shares: shares(step.filter), name: 'What reaches the memory, s(M)', outside: false};
    return {shares: shares(step.gaze), name: 'Where it looks (M)', outside: true, nowhere: step.nowhere};
  }

  function drawMap(step) {
    if (!step.gaze) {
      $('map-name').textContent = 'Where it looks';
      $('map').innerHTML = '<p class="note">This agent has no attention.</p>';
      $('map-note').textContent = '';
      $('choices').innerHTML = '';
      return;
    }
    const map = currentMap(step);
    $('map-name').textContent = map.name;
    const small = (type) => type <= TYPE.empty ? 0 : type === TYPE.wall ? .4 : .6;
    $('map').innerHTML = drawGrid(step, (c) => heat(map.shares[c]), small, mapText(step, map));
    const rest = map.nowhere !== undefined ? map.nowhere : Math.max(0, 1 - sum(map.shares));
    $('map-note').innerHTML = !map.outside ? 'The factor of each cell.' : rest > .5
      ? `<strong>Not in view</strong>: ${fixed(rest)} on nowhere.` : `${fixed(rest)} on nowhere.`;
    $('choices').innerHTML = step.filter ? [['M', false], ['s(M)', true]].map(([name, value]) =>
      `<button data-filter="${value}" aria-pressed="${state.filter === value}">${name}</button>`).join('') : '';
  }

  function mapText(step, map) {
    const best = map.shares.indexOf(Math.max(...map.shares));
    return `${map.name}: brightest is ${cellName(step, best)} with ${fixed(map.shares[best])}`;
  }
  function cellName(step, c) {
    const image = bytes(step.image), ahead = 6 - c % SIDE, right = Math.floor(c / SIDE) - 3;
    const where = [ahead ? `${ahead} ahead` : '', right ? `${Math.abs(right)} ${right > 0 ? 'right' : 'left'}` : ''].filter(Boolean);
    return `${nameOf(image[3 * c], image[3 * c + 1], image[3 * c + 2])}, ${where.join(' and ') || 'its own cell'}`;
  }
  function seenThings(step) {
    const image = bytes(step.image), things = [];
    for (let c = 0; c < CELLS; ++c) if (image[3 * c] > TYPE.wall && c !== 27) things.push(cellName(step, c));
    return things.join('; ') || 'nothing but walls';
  }

  function without(step) {
    if (!step.what_if) return null;
    const i = word(), c = cell();
    if (i >= 0 && step.what_if.words) return [`without “${state.episode.words[i]}”`, shares(step.what_if.words[i])];
    if (c >= 0 && step.what_if.cells && step.what_if.cells[c]) return [`without the ${cellName(step, c)}`, shares(step.what_if.cells[c])];
    return null;
  }

  function drawPolicy(step) {
    const chosen = data.actions[step.action] || `action ${step.action}`;
    const policy = shares(step.policy), other = without(step);
    $('policy').innerHTML = policy.map((p, a) => {
      const bar = (share, kind) => `<div class="bar ${kind}" style="--share:${share.toFixed(3)}"><i></i></div>`;
      return `<div class="action${a === step.action ? ' chosen' : ''}"><span><span>${escape(data.actions[a])}</span><span>${fixed(p)}` +
        `${other ? `<em>${fixed(other[1][a])}</em>` : ''}</span></span>${bar(p, '')}` +
        `${other ? bar(other[1][a], 'without') : ''}</div>`;
    }).join('') || '<p class="note">The log does not say.</p>';
    $('policy-note').innerHTML = other ? `Blue: ${escape(other[0])}.`
      : `${step.pending ? 'Would do' : 'Does'}: <b>${escape(chosen)}</b>. Value ${fixed(step.value)}${step.reward ? `, reward ${fixed(step.reward)}` : ''}.`;
  }

  function drawWords(step) {
    const e = state.episode, weights = shares(step.weights), mask = shares(step.mask);
    const masked = mask.some((a) => a < .995), c = cell();
    $('words').innerHTML = e.words.map((text, i) => {
      const of = step.sub_task_of ? step.sub_task_of[i] : -1;
      const done = of >= 0 && step.done && step.done[of], waits = of >= 0 && !done && step.turn && !step.turn[of];
      const looks = c >= 0 && step.maps ? mapOf(step, i)[c] : 0;
      const bar = (name, share, color) => `<span class="bar" style="--share:${share};--color:var(--${color})">${name}<i></i>${fixed(share)}</span>`;
      const label = `${text}${done ? ', done' : waits ? ', its turn comes later' : ''}` +
        (weights.length ? `: weight ${fixed(weights[i])}${masked ? `, mask ${fixed(mask[i])}` : ''}` : '');
      return `<button class="word${done ? ' done' : ''}${waits ? ' waiting' : ''}" data-word="${i}" aria-pressed="${state.word === i}" aria-label="${escape(label)}">` +
        `<b>${escape(text)}</b>${weights.length ? bar('w', weights[i], 'accent') : ''}${weights.length && masked ? bar('α', mask[i], 'calm') : ''}` +
        `${looks >= .05 ? `<span class="here">${fixed(looks)}</span>` : ''}</button>`;
    }).join('');
    $('hint').textContent = c >= 0 ? `The numbers at the words: how much of each map lies on the ${cellName(step, c)}.`
      : step.maps ? 'Bars from 0 to 1. Tap a word for its map, a cell for its words.' : '';
  }

  function drawCurve() {
    const all = steps(), n = all.length, W = 600, H = 90, L = 34;
    const values = all.map((s) => s.value ?? 0), rewards = all.map((s) => s.reward ?? 0);
    const low = Math.min(0, ...values, ...rewards), high = Math.max(1, ...values, ...rewards);
    const x = (i) => L + (n < 2 ? 0 : i * (W - L - 8) / (n - 1)), y = (v) => 8 + (high - v) / (high - low) * (H - 22);
    const line = values.map((v, i) => `${x(i).toFixed(1)},${y(v).toFixed(1)}`).join(' ');
    const ends = rewards.map((r, i) => r ? `<circle cx="${x(i)}" cy="${y(r)}" r="4" fill="#15803d"><title>reward ${fixed(r)}</title></circle>` : '').join('');
    const label = (v) => `<text x="${L - 6}" y="${y(v) + 4}" text-anchor="end" font-size="10" fill="currentColor" opacity=".7">${v}</text>` +
      `<path d="M${L} ${y(v)}H${W - 8}" stroke="currentColor" opacity=".15"/>`;
    $('curve').innerHTML = `<svg viewBox="0 0 ${W} ${H}" role="img" aria-label="Value over time, reward as dots" style="cursor:pointer">` +
      `${label(0)}${label(1)}<polyline points="${line}" fill="none" stroke="#3b82f6" stroke-width="1.8"/>${ends}` +
      `<path d="M${x(state.step)} 4V${H - 14}" stroke="var(--accent)" stroke-width="2"/>` +
      `<text x="${L}" y="${H - 2}" font-size="10" fill="currentColor" opacity=".7">value (line) and reward (dots) by step</text></svg>`;
    $('curve').onclick = (event) => {
      const box = $('curve').getBoundingClientRect();
      go(Math.round(((event.clientX - box.left) / box.width * W - L) / (W - L - 8) * (n - 1)));
    };
  }

  // What a screen reader says, and all else that wants words.
  function describe(step) {
    const parts = [`Step ${step.step}: ${data.actions[step.action] || 'acts'}`];
    if (step.gaze) {
      const map = {shares: shares(step.gaze), name: 'looks'};
      parts.push(step.nowhere > .5 ? 'what is meant is not in view' : mapText(step, map).replace('looks: brightest is', 'looks at'));
    }
    if (step.reward) parts.push(`reward ${fixed(step.reward)}`);
    return parts.join('; ') + '.';
  }

  // ---- the list --------------------------------------------------------------------------------------
  const outcome = (e) => e.success === undefined ? 'open' : e.success ? 'success' : 'failure';
  const key = (e) => `${e.run} ${e.id}`;
  function listed() {
    const [wanted, run, join, order] = ['outcome', 'run', 'join', 'order'].map((id) => $(id).value);
    const list = state.episodes.filter((e) => (wanted === 'all' || outcome(e) === wanted) && (!run || e.run === run) &&
      (!join || (join === 'one' ? !JOINS.some((j) => e.words.includes(j)) : e.words.includes(join))));
    if (order === 'worst') list.sort((a, b) => (a.success === b.success ? (a.return ?? 0) - (b.return ?? 0) : a.success ? 1 : -1));
    if (order === 'longest') list.sort((a, b) => b.steps.length - a.steps.length);
    return list;
  }
  function drawList() {
    const list = listed();
    $('episodes').innerHTML = list.map((e) => `<li><button class="${outcome(e)}" data-key="${escape(key(e))}" aria-current="${e === state.episode}">` +
      `${escape(e.mission || 'no mission')}<small>${escape(String(e.id))}: ${{success: 'success', failure: e.truncated ? 'out of time' : 'failure', open: 'not ended'}[outcome(e)]}, ` +
      `${e.steps.length} steps</small></button></li>`).join('') || '<li class="note">No such episode.</li>';
    const ended = state.episodes.filter((e) => e.success !== undefined), good = ended.filter((e) => e.success).length;
    $('summary').textContent = `${state.episodes.length} episodes` + (ended.length ? `, ${good} of ${ended.length} that ended with success` : '');
  }
  function fill(id, values, names = values) {
    const chosen = $(id).value;
    $(id).replaceChildren($(id).options[0], ...values.map((v, i) => new Option(names[i], v)));
    $(id).value = values.includes(chosen) ? chosen : '';
  }
  function fillFilters() {
    fill('run', [...new Set(state.episodes.map((e) => e.run))].filter(Boolean).sort());
    const joins = JOINS.filter((j) => state.episodes.some((e) => e.words.includes(j)));
    fill('join', joins.length ? ['one', ...joins] : [], joins.length ? ['one clause', ...joins.map((j) => `“${j}”`)] : []);
  }

  // ---- all of it -------------------------------------------------------------------------------------
  function draw() {
    const step = now(), e = state.episode;
    $('facts').hidden = $('words').hidden = !e;
    document.querySelector('.panels').hidden = document.querySelector('.player').hidden = !e;
    if (!e) return;
    $('facts').textContent = `Episode ${e.id}${e.run ? ` of ${e.run}` : ''} in ${e.env}, seed ${e.seed}` +
      (e.success === undefined ? '' : e.success ? `: success, return ${fixed(e.return)}` : e.truncated ? ': out of time' : ': failure');
    $('step').max = Math.max(0, steps().length - 1);
    $('step').value = state.step;
    $('step-text').textContent = steps().length ? `step ${state.step + 1} of ${steps().length}` : 'no step yet';
    if (!step) return;
    drawWords(step);
    drawWorld(step);
    drawView(step);
    drawMap(step);
    drawPolicy(step);
    drawCurve();
  }
  function say() { if (now() && !state.playing) $('said').textContent = describe(now()); }
  function go(step) {
    state.step = Math.max(0, Math.min(steps().length - 1, step));
    state.overCell = state.overWord = -1;
    draw();
    say();
  }
  function open(episode) {
    Object.assign(state, {episode, step: state.follow && data.live ? Math.max(0, episode.steps.length - 1) : 0, word: -1, cell: -1, overWord: -1, overCell: -1});
    drawList();
    draw();
    say();
  }
  function neighbor(by) {
    const list = listed(), i = list.indexOf(state.episode);
    const next = list[Math.max(0, Math.min(list.length - 1, i + by))];
    if (next) open(next);
    document.querySelector('#episodes [aria-current=true]')?.scrollIntoView({block: 'nearest'});
  }
  function play(on) {
    clearInterval(state.playing);
    state.playing = on ? setInterval(() => {
      if (state.step + 1 < steps().length) go(state.step + 1);
      else play(false);
    }, 600) : null;
    if (on && state.step + 1 >= steps().length) go(0);
    $('play').textContent = on ? 'Pause' : 'Play';
    $('play').setAttribute('aria-label', on ? 'Pause' : 'Play');
    if (!on) say();
  }

  // ---- events ----------------------------------------------------------------------------------------
  $('episodes').addEventListener('click', (event) => {
    const button = event.target.closest('button');
    if (button) open(state.episodes.find((e) => key(e) === button.dataset.key));
  });
  $('words').addEventListener('click', (event) => {
    const button = event.target.closest('.word');
    if (!button) return;
    const i = Number(button.dataset.word);
    Object.assign(state, {word: state.word === i ? -1 : i, cell: -1, overWord: -1});
    draw();
    $('words').querySelector(`[data-word="${i}"]`).focus();
  });
  const hover = (id, name, attribute) => {
    $(id).addEventListener('pointerover', (event) => {
      const at = event.target.closest(`[data-${attribute}]`);
      const value = at && event.pointerType === 'mouse' ? Number(at.dataset[attribute]) : -1;
      if (state[name] === value) return;
      state[name] = value;
      draw();
    });
    $(id).addEventListener('pointerleave', () => {
      if (state[name] < 0) return;
      state[name] = -1;
      draw();
    });
  };
  hover('words', 'overWord', 'word');
  for (const id of ['view', 'map']) {
    hover(id, 'overCell', 'cell');
    $(id).addEventListener('click', (event) => {
      const at = event.target.closest('[data-cell]');
      if (!at) return;
      const c = Number(at.dataset.cell);
      Object.assign(state, {cell: state.cell === c ? -1 : c, word: -1, overCell: -1});
      draw();
    });
  }
  $('choices').addEventListener('click', (event) => {
    if (event.target.dataset.filter === undefined) return;
    state.filter = event.target.dataset.filter === 'true';
    draw();
  });
  $('previous').onclick = () => go(state.step - 1);
  $('next').onclick = () => go(state.step + 1);
  $('play').onclick = () => play(!state.playing);
  $('step').oninput = () => go(Number($('step').value));
  for (const id of ['outcome', 'run', 'join', 'order']) {
    $(id).onchange = () => {
      drawList();
      if (!listed().includes(state.episode) && listed().length) open(listed()[0]);
    };
  }
  document.addEventListener('keydown', (event) => {
    if (event.target.tagName === 'SELECT' || event.target.id === 'mission' || event.ctrlKey || event.metaKey || event.altKey) return;
    const on = event.target.tagName, keys = {
      ArrowLeft: () => go(state.step - 1), ArrowRight: () => go(state.step + 1), Home: () => go(0), End: () => go(steps().length - 1),
      n: () => neighbor(1), p: () => neighbor(-1), ' ': () => on !== 'BUTTON' && play(!state.playing),
      Escape: () => { Object.assign(state, {word: -1, cell: -1, overWord: -1, overCell: -1}); draw(); }};
    const act = keys[event.key];
    if (!act || (event.key === ' ' && on === 'BUTTON')) return;
    event.preventDefault();
    act();
  });

  // ---- live: the same, told piece by piece ----------------------------------------------------------
  const KEPT = 300;  // episodes
  const curves = new Map();  // of learning, by name: [frames, number]
  const SHOWN = ['success_rate', 'mean_return', 'entropy', 'value_loss', 'hit', 'mask_accuracy'];

  function drawLearning() {
    const names = SHOWN.filter((name) => curves.has(name));
    $('learning').hidden = !names.length;
    $('learning').innerHTML = names.map((name) => {
      const points = curves.get(name), last = points[points.length - 1];
      const most = last[0] || 1, high = Math.max(1e-9, ...points.map((q) => q[1]), name === 'success_rate' ? 1 : 0);
      const low = Math.min(0, ...points.map((q) => q[1]));
      const line = points.map(([x, y]) => `${(190 * x / most).toFixed(1)},${(44 - 42 * (y - low) / (high - low)).toFixed(1)}`);
      return `<figure><figcaption>${escape(name)} <b>${last[1].toFixed(3)}</b></figcaption><svg viewBox="0 0 190 46" role="img" ` +
        `aria-label="${escape(name)} over ${most} frames, now ${last[1].toFixed(3)}"><polyline points="${line.join(' ')}" fill="none" stroke="var(--accent)" stroke-width="1.5"/></svg></figure>`;
    }).join('');
  }
  function learn(told) {
    for (const [name, number] of Object.entries(told.scalars)) {
      if (number === null) continue;
      if (!curves.has(name)) curves.set(name, []);
      const points = curves.get(name);
      points.push([told.frames, number]);
      if (points.length > 600) curves.set(name, points.filter((_, i) => i % 2 || i === points.length - 1));
    }
    drawLearning();
  }

  function hear(told) {
    if (told.note !== undefined) {
      $('note').textContent = told.note;
      $('note').hidden = !told.note;
      return;
    }
    if (told.scalars) return learn(told);
    if (told.begin) {
      state.episodes.push({...told.begin, steps: []});
      if (state.episodes.length > KEPT) state.episodes.shift();
      fillFilters();
      if (state.follow || !state.episode) open(state.episodes[state.episodes.length - 1]);
      else drawList();
      return;
    }
    const episode = state.episodes.find((e) => e.id === told.episode && e.success === undefined);
    if (!episode) return;
    if (told.end) {
      Object.assign(episode, told.end);
      episode.steps = episode.steps.filter((s) => !s.pending);
      drawList();
      if (episode === state.episode) go(state.step);
      return;
    }
    const {steps: all} = episode, last = all[all.length - 1];
    if (last && last.step === told.step.step) all[all.length - 1] = {...last, pending: false, ...told.step};
    else all.push(told.step);
    if (episode === state.episode) {
      if (state.follow) go(all.length - 1);
      else draw();
    }
  }

  function command(what) {
    fetch('command', {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify(what)});
  }
  function offerCommands() {
    $('commands').hidden = false;
    document.querySelector('.keys').innerHTML = data.actions.map((name) => `<button type="button" data-action="${escape(name)}">${escape(name)}</button>`).join('');
    $('commands').addEventListener('click', (event) => {
      if (event.target.dataset.action) command({action: event.target.dataset.action});
    });
    const agent = (on) => {
      $('agent-on').setAttribute('aria-pressed', on);
      $('agent-on').textContent = on ? 'Agent: stop' : 'Agent: go';
      command({who: on ? 'agent' : 'person'});
    };
    $('agent-step').onclick = () => command({who: 'step'});
    $('agent-on').onclick = () => agent($('agent-on').getAttribute('aria-pressed') !== 'true');
    $('next-world').onclick = () => command({next: true});
    $('commands').onsubmit = (event) => {
      event.preventDefault();
      if ($('mission').value.trim()) command({mission: $('mission').value.trim()});
    };
    const keys = {ArrowUp: 'forward', ArrowLeft: 'turn left', ArrowRight: 'turn right', u: 'pick up', d: 'drop', t: 'toggle', e: 'done'};
    document.addEventListener('keydown', (event) => {
      if (['INPUT', 'SELECT'].includes(event.target.tagName) || event.ctrlKey || event.metaKey || event.altKey) return;
      if (keys[event.key]) command({action: keys[event.key]});
      else if (event.key === 's') $('agent-step').click();
      else if (event.key === 'g') $('agent-on').click();
      else if (event.key === 'w') $('next-world').click();
      else return;
      event.preventDefault();
      event.stopImmediatePropagation();
    }, true);
  }

  document.querySelector('.scale i').style.background = gradient;
  state.episodes = data.episodes;
  fillFilters();
  drawList();
  if (state.episodes.length) open(state.episodes[0]);
  else draw();
  if (data.live) {
    $('follow-label').hidden = false;
    $('follow').onchange = () => { state.follow = $('follow').checked; };
    if (data.commands) offerCommands();
    const events = new EventSource('events');
    events.onmessage = (event) => hear(JSON.parse(event.data));
    events.onerror = () => hear({note: 'The program has ended or cannot be reached.'});
    events.onopen = () => { state.episodes = []; state.episode = null; curves.clear(); hear({note: ''}); drawList(); };
  }
})();
