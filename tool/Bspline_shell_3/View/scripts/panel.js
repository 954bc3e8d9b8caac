// Buttons, the slider, the choice of colors, and the keys that do the same.
class Panel {
  constructor(state) {
    Object.assign(this, state); // views, orbit, meshes, channels, surfaces, section, cursor
    this.showsEdges = false;
    this.followsCenter = false; // whether the cursor is at the center of the first view
    this.channel = this.channels.list[0];
    this.element = id => document.getElementById(id);
    this.fillChoice();
    this.bind();
    for (const axis of ["x", "y", "z"]) this.element("clip-" + axis).title = "cut across " + axis + " (key " + axis + ")";
    this.element("surfaces").hidden = !this.surfaces.exist;
    this.refresh();
  }

  fillChoice() {
    const choice = this.element("channel");
    this.channels.list.forEach((channel, n) => choice.append(new Option(channel.title, n)));
    choice.addEventListener("change", () => this.setChannel(Number(choice.value)));
  }

  setChannel(n) {
    this.channel = this.channels.list[n];
    this.element("channel").value = n;
    this.refresh();
  }

  // Commands by the identifier of their button, with their keys.
  get commands() {
    const turning = 0.1, moving = 0.05, zooming = 1.15, sliding = 0.02;
    const camera = action => () => {
      action();
      if (this.followsCenter) this.pickCenter();
      this.views.move();
    };
    return [
      [["ArrowLeft"], camera(() => this.orbit.turn(-turning, 0))], [["ArrowRight"], camera(() => this.orbit.turn(turning, 0))],
      [["ArrowUp"], camera(() => this.orbit.turn(0, -turning))], [["ArrowDown"], camera(() => this.orbit.turn(0, turning))],
      [["Shift+ArrowLeft"], camera(() => this.orbit.move(-moving, 0))], [["Shift+ArrowRight"], camera(() => this.orbit.move(moving, 0))],
      [["Shift+ArrowUp"], camera(() => this.orbit.move(0, moving))], [["Shift+ArrowDown"], camera(() => this.orbit.move(0, -moving))],
      [["+", "="], camera(() => this.orbit.zoom(zooming)), "nearer"], [["-"], camera(() => this.orbit.zoom(1 / zooming)), "farther"],
      [["0"], camera(() => this.orbit.reset()), "whole"],
      [["e"], () => { this.showsEdges = !this.showsEdges; }, "edges"],
      [["s"], () => this.surfaces.show(this.surfaces.exist && !this.surfaces.isShown, this.views.scenes), "surfaces"],
      [["m"], () => this.meshes.forEach(mesh => { mesh.object.visible = !mesh.object.visible; }), "meshes"],
      [["c"], () => this.setChannel((this.channels.list.indexOf(this.channel) + 1) % this.channels.list.length)],
      [["x"], () => this.clip(0), "clip-x"], [["y"], () => this.clip(1), "clip-y"], [["z"], () => this.clip(2), "clip-z"],
      [["["], () => this.slide(this.section.position - sliding)], [["]"], () => this.slide(this.section.position + sliding)],
      [["f"], () => { this.section.isFlipped = !this.section.isFlipped; }, "flip"],
      [["p"], () => { this.followsCenter = !this.followsCenter; this.pickCenter(); }, "center"],
      [["Enter"], camera(() => focusOnCursor(this.orbit, this.cursor))],
      [["Escape"], () => { this.followsCenter = false; this.cursor.clear(); }],
      [["h", "?"], () => this.toggleHelp(), "help"]
    ];
  }

  bind() {
    const byKey = new Map();
    for (const [keys, action, id] of this.commands) {
      const run = () => {
        action();
        this.refresh();
      };
      for (const key of keys) byKey.set(key, run);
      if (id) this.element(id).addEventListener("click", run);
    }
    window.addEventListener("keydown", event => {
      const isArrow = event.key.startsWith("Arrow"), tag = event.target.tagName;
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (tag === "SELECT" || (tag === "INPUT" && isArrow) || (tag === "BUTTON" && event.key === "Enter")) return;
      const run = byKey.get((event.shiftKey && isArrow ? "Shift+" : "") + event.key);
      if (!run || (this.element("help-text").open && !["h", "?"].includes(event.key))) return;
      event.preventDefault();
      run();
    });
    this.element("clip").addEventListener("input", event => {
      this.slide(Number(event.target.value));
      this.refresh();
    });
  }

  clip(axis) {
    this.section.axis = this.section.axis === axis ? null : axis;
  }

  slide(position) {
    if (this.section.axis === null) this.section.axis = 0;
    this.section.position = Math.min(Math.max(position, -1), 1);
  }

  // Moves the cursor to the center of the first view.
  pickCenter() {
    if (this.followsCenter) this.cursor.pick(this.views.lineInView(0));
    else this.cursor.clear();
    this.cursor.isFixed = this.followsCenter;
    this.describeCursor();
  }

  toggleHelp() {
    const help = this.element("help-text");
    if (help.open) help.close();
    else help.showModal();
  }

  describeCursor() {
    showCursor(this.element("cursor"), this.cursor, this.meshes, this.channel);
  }

  // Makes the pictures and buttons agree with the state.
  refresh() {
    if (this.painted !== this.channel) {
      for (const mesh of this.meshes) mesh.paint(Channels.colors(this.channel, mesh), Boolean(this.channel.isOwn));
      this.painted = this.channel;
    }
    for (const mesh of this.meshes) mesh.showEdges(this.showsEdges);
    this.section.update();
    const isPressed = {
      edges: this.showsEdges, surfaces: this.surfaces.isShown, meshes: this.meshes[0].object.visible, flip: this.section.isFlipped,
      center: this.followsCenter, "clip-x": this.section.axis === 0, "clip-y": this.section.axis === 1, "clip-z": this.section.axis === 2
    };
    for (const [id, value] of Object.entries(isPressed)) this.element(id).setAttribute("aria-pressed", value);
    this.element("clip").value = this.section.position;
    showLegend(this.element("legend"), this.channel, this.section, this.surfaces);
    this.describeCursor();
    this.views.redraw();
  }
}
