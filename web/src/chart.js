// Line charts for pages without a machine view.
import { pageData } from "./data.js";
import { lineChart } from "./line_chart.js";

for (const chart of pageData().charts ?? []) {
  lineChart(document.getElementById(chart.element), chart);
}
