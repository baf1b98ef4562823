// What makes the page move: libraries and runs lie in it compressed, and are unpacked when they are needed.

const unpacked = async (id) => {
  const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
};

// Tables sort by a click on a heading and filter by the words in their search field; columns of few
// different words offer these as a list.
const makeTablesSortable = async () => {
  const style = document.createElement("style");
  style.textContent = await unpacked("datatables-style");
  document.head.prepend(style); // the page's own style wins
  const script = new Blob([await unpacked("datatables")], { type: "text/javascript" });
  const { default: DataTable } = await import(URL.createObjectURL(script));
  for (const table of document.querySelectorAll("table.sortable")) {
    new DataTable(table, {
      paging: false,
      order: [],
      autoWidth: false,
      layout: { topStart: "search", topEnd: "info", bottomStart: null, bottomEnd: null },
      language: { search: "", searchPlaceholder: "filter by words", info: "_TOTAL_ rows", infoFiltered: "of _MAX_" },
      columnDefs: [{ targets: "choose", columnControl: [["searchList"]] }],
      ordering: { indicators: true, handler: true },
    });
  }
};

// Plotly rejects the promise of an animation that another one interrupts, without a reason; nobody waits
// for it, and the browser would complain.
window.addEventListener("unhandledrejection", (event) => {
  if (event.reason === undefined) event.preventDefault();
});

// A run is drawn when it comes into view.
const drawRunsInMotion = () => {
  let plotly;
  const load = async () => {
    const script = document.createElement("script");
    script.textContent = await unpacked("plotly");
    document.head.append(script);
  };
  const draw = async (place) => {
    await (plotly ??= load());
    const figure = JSON.parse(await unpacked(`${place.id}-figure`));
    await Plotly.newPlot(place, figure.data, figure.layout, { responsive: true, displayModeBar: false });
    await Plotly.addFrames(place, figure.frames);
    place.dataset.ready = "yes";
  };
  const watcher = new IntersectionObserver(
    (entries) => {
      for (const { target } of entries.filter((entry) => entry.isIntersecting)) {
        watcher.unobserve(target);
        draw(target);
      }
    },
    { rootMargin: "300px" },
  );
  for (const place of document.querySelectorAll(".motion")) watcher.observe(place);
};

await makeTablesSortable();
drawRunsInMotion();
