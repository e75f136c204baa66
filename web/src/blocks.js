// The program's blocks as a list that draws only the rows in sight.
const rowHeight = 24;

export class BlockList {
  constructor(element, lines, onChoose) {
    this.element = element;
    this.lines = lines;
    this.chosen = -1;
    this.space = document.createElement("div");
    this.space.setAttribute("role", "presentation");
    this.space.style.height = `${lines.length * rowHeight}px`;
    element.append(this.space);
    element.addEventListener("scroll", () => this.draw());
    element.addEventListener("click", (event) => {
      const row = event.target.closest(".row");
      if (row) onChoose(Number(row.dataset.line));
    });
    element.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!step) return;
      event.preventDefault();
      onChoose(Math.min(lines.length - 1, Math.max(0, this.chosen + step)));
    });
    this.draw();
  }

  draw() {
    const first = Math.max(0, Math.floor(this.element.scrollTop / rowHeight) - 4);
    const last = Math.min(this.lines.length,
      first + Math.ceil(this.element.clientHeight / rowHeight) + 8);
    const rows = [];
    for (let i = first; i < last; ++i) {
      const row = document.createElement("div");
      row.className = i === this.chosen ? "row chosen" : "row";
      row.style.top = `${i * rowHeight}px`;
      row.dataset.line = i;
      row.setAttribute("role", "option");
      row.setAttribute("aria-selected", String(i === this.chosen));
      row.textContent = `${String(i + 1).padStart(5)}  ${this.lines[i] ?? "(a large program: not in this page)"}`;
      rows.push(row);
    }
    this.space.replaceChildren(...rows);
  }

  choose(line) {
    if (line === this.chosen) return;
    this.chosen = line;
    const top = line * rowHeight;
    const { scrollTop, clientHeight } = this.element;
    if (top < scrollTop || top + rowHeight > scrollTop + clientHeight)
      this.element.scrollTop = Math.max(0, top - clientHeight / 2);
    this.draw();
  }
}
