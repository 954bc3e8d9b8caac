// Sorts the table by the column whose head is clicked, and hides rows that do not match the search text.
const body = document.querySelector(".meshes tbody"), heads = [...document.querySelectorAll(".meshes thead th")], rows = [...body.rows];
const search = document.querySelector(".filter input"), count = document.getElementById("count");
const collator = new Intl.Collator("en", { numeric: true });
heads.forEach((head, column) => head.querySelector("button")?.addEventListener("click", () => {
  const up = head.getAttribute("aria-sort") !== "ascending";
  const values = new Map(rows.map(row => [row, row.cells[column].dataset.value]));
  const isNumeric = rows.every(row => !isNaN(values.get(row)));
  rows.sort((a, b) => {
    const x = values.get(a), y = values.get(b);
    if(x === "" || y === "") return (x === "") - (y === "");        // missing values come last
    const order = isNumeric ? x - y : collator.compare(x, y);
    return up ? order : -order;
  });
  heads.forEach(other => other.removeAttribute("aria-sort"));
  head.setAttribute("aria-sort", up ? "ascending" : "descending");
  body.append(...rows);
}));
const filter = () => {
  const text = search.value.toLowerCase();
  let number = 0;
  for(const row of rows) {
    const reason = row.cells[2].title;
    row.hidden = !(row.textContent + " " + reason).toLowerCase().includes(text);
    number += !row.hidden;
  }
  count.textContent = number + (number === 1 ? " mesh" : " meshes");
};
search.addEventListener("input", filter);
filter();
