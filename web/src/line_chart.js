// A line chart that follows the width of its element and the colours of the page.
import uPlot from "uplot";

const colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

function ink(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** chart: { x: {label, values}, y: {label}, series: [{label, values}], onPoint? } */
export function lineChart(element, chart) {
  const axis = (label) => ({
    label, stroke: ink("--soft"), grid: { stroke: ink("--rule"), width: 1 },
    ticks: { stroke: ink("--rule") }, labelSize: 22, font: "12px system-ui",
    labelFont: "12px system-ui",
  });
  const options = {
    width: element.clientWidth, height: 220, scales: { x: { time: false } },
    axes: [axis(chart.x.label), { ...axis(chart.y.label), size: 64, labelGap: 6 }],
    series: [{ label: chart.x.label }, ...chart.series.map((s, i) => ({
      label: s.label, stroke: colours[i % colours.length], width: 1.5,
      points: { show: s.values.length < 5000, size: s.values.length < 500 ? 7 : 4, width: 1 },
    }))],
    legend: { show: chart.series.length > 1, live: false },
    cursor: { drag: { x: true, y: false } },
  };
  const plot = new uPlot(options, [chart.x.values, ...chart.series.map((s) => s.values)], element);
  new ResizeObserver(() => plot.setSize({ width: element.clientWidth, height: 220 }))
    .observe(element);
  // A4 is narrower than the screen, and a canvas does not flow.
  addEventListener("beforeprint", () => plot.setSize({ width: 640, height: 220 }));
  addEventListener("afterprint", () => plot.setSize({ width: element.clientWidth, height: 220 }));
  if (chart.onPoint) {
    plot.over.addEventListener("click", () => {
      if (plot.cursor.idx != null) chart.onPoint(plot.cursor.idx);
    });
  }
  return plot;
}
