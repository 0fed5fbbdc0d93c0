// What the window tells screen readers, as elements over the canvas: there they are found, read and clicked, and not seen.
const roles = {
  Button: "button", DisclosureTriangle: "button", CheckBox: "checkbox", RadioButton: "radio", Slider: "slider", SpinButton: "spinbutton",
  TextInput: "textbox", MultilineTextInput: "textbox", ComboBox: "combobox", Link: "link", ProgressIndicator: "progressbar", Image: "img",
  Splitter: "separator",
};
const checked = new Set(["checkbox", "radio"]);

// Shows `told()` in `place` from now on, and says results and lessons in `said` and `lesson`.
export function mirror(told, canvas, place, said, lesson) {
  const known = new Map();
  let before = "";

  function click({ currentTarget }) {
    const { left, top, width, height } = currentTarget.getBoundingClientRect();
    const at = { clientX: left + width / 2, clientY: top + height / 2, pointerId: 1, pointerType: "mouse", isPrimary: true, bubbles: true };
    const send = (kind, buttons) => canvas.dispatchEvent(new PointerEvent(kind, { ...at, button: kind === "pointermove" ? -1 : 0, buttons }));
    send("pointermove", 0);
    send("pointerdown", 1);
    setTimeout(() => send("pointerup", 0), 100);
  }

  function element({ id }) {
    const made = document.createElement("div");
    made.id = `told-${id}`;
    made.addEventListener("click", click);
    known.set(id, made);
    return made;
  }

  function update(shown, { role, label, value, number, range, on, disabled, box }) {
    const is = roles[role];
    const text = is ? "" : [label, value].filter(Boolean).join(": ");
    if (shown.textContent !== text) shown.textContent = text;
    const attributes = {
      role: is,
      "aria-label": is && label,
      "aria-valuetext": is && value,
      "aria-valuenow": is && number,
      "aria-valuemin": is && range[0],
      "aria-valuemax": is && range[1],
      [checked.has(is) ? "aria-checked" : "aria-pressed"]: is && on,
      "aria-disabled": disabled || null,
    };
    for (const [name, now] of Object.entries(attributes)) {
      if (now === null || now === undefined || now === "") shown.removeAttribute(name);
      else if (shown.getAttribute(name) !== `${now}`) shown.setAttribute(name, now);
    }
    const [left, top, right, bottom] = box ?? [0, 0, 0, 0];
    shown.style.cssText = `left:${left}px;top:${top}px;width:${right - left}px;height:${bottom - top}px`;
  }

  function say(where, what) {
    if (where.textContent !== (what ?? "")) where.textContent = what ?? "";
  }

  function show() {
    const now = told();
    if (now === before) return;
    before = now;
    const { run, focus, nodes } = JSON.parse(now);
    nodes.forEach((node, i) => {
      const shown = known.get(node.id) ?? element(node);
      update(shown, node);
      if (place.children[i] !== shown) place.insertBefore(shown, place.children[i] ?? null);
    });
    for (const gone of [...place.children].slice(nodes.length)) {
      known.delete(gone.id.slice("told-".length));
      gone.remove();
    }
    if (known.has(focus)) canvas.setAttribute("aria-activedescendant", `told-${focus}`);
    else canvas.removeAttribute("aria-activedescendant");
    say(said, run?.said);
    say(lesson, run?.lesson);
  }
  setInterval(show, 500);
}
