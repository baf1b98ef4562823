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
  const made = [];
  for (const table of document.querySelectorAll("table.sortable")) {
    const one = new DataTable(table, {
      paging: false,
      order: [],
      autoWidth: false,
      layout: { topStart: "search", topEnd: "info", bottomStart: null, bottomEnd: null },
      language: { search: "", searchPlaceholder: "filter by words", info: "_TOTAL_ rows", infoFiltered: "of _MAX_",
        infoEmpty: "no row", zeroRecords: "no row matches", emptyTable: "no row" },
      columnDefs: [{ targets: ["of-paper", "of-verdict"], columnControl: [["searchList"]] }],
      ordering: { indicators: true, handler: true },
    });
    if (table.classList.contains("graded")) made.push(one);
  }
  return made;
};

// A part of a bar shows the numbers and claims of its paper and verdict; the button shows all again.
const letBarsFilter = (tables) => {
  const told = document.querySelector(".chosen-filter");
  const show = (paper, verdict) => {
    for (const table of tables) {
      table.column(".of-paper").search(paper, { exact: true });
      table.column(".of-verdict").search(verdict, { exact: true }).draw();
    }
    told.hidden = !verdict;
    told.querySelector("span").textContent = `Shown: ${paper}, ${verdict}.`;
  };
  const parts = document.querySelectorAll(".bar a");
  for (const part of parts) {
    part.addEventListener("click", () => {
      for (const other of parts) other.classList.toggle("chosen", other === part);
      show(part.dataset.paper, part.dataset.verdict);
    });
  }
  told?.querySelector("button").addEventListener("click", () => {
    for (const part of parts) part.classList.remove("chosen");
    show("", "");
  });
  return () => show("", "");
};

// A link to a row or a scene that a filter or an opener hides shows it.
const followLinks = (showAll) => {
  const reveal = (id) => {
    if (id.startsWith("claim-") && !document.getElementById(id)) showAll();
    const place = document.getElementById(id);
    for (let above = place; above; above = above.parentElement) {
      if (above.tagName === "DETAILS") above.open = true;
    }
    const chapter = place?.querySelector(":scope > details.chapter"); // a chapter is named by its section
    if (chapter) chapter.open = true;
    return place;
  };
  document.addEventListener("click", (event) => {
    const id = event.target.closest?.('a[href^="#"]')?.getAttribute("href").slice(1);
    if (id && !event.target.closest(".bar")) reveal(id);
  });
  // the address named a place before tables took their heights
  if (location.hash) reveal(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();
};

// Figures open as large as the window allows; where that is smaller than they are, a click shows their full size.
const enlargeFigures = () => {
  const dialog = document.querySelector("dialog");
  const large = dialog.querySelector("img");
  const buttons = [...document.querySelectorAll("button.enlarge")];
  const caption = dialog.querySelector(".caption");
  let shown = 0;
  const look = () => {
    const whole = !dialog.classList.contains("natural");
    dialog.classList.toggle("shrunk", whole && large.naturalWidth > large.clientWidth);
  };
  large.addEventListener("load", look);
  const show = (number) => {
    shown = (number + buttons.length) % buttons.length;
    const figure = buttons[shown].closest("figure");
    const small = figure.querySelector("img");
    dialog.classList.remove("natural", "shrunk");
    large.src = small.src;
    large.alt = small.alt;
    const heading = figure.querySelector("h4")?.textContent ?? "";
    caption.textContent = `${heading}. ${figure.querySelector("figcaption")?.firstChild?.textContent.trim() ?? ""}`;
    if (!dialog.open) dialog.showModal();
    look();
  };
  buttons.forEach((button, number) => button.addEventListener("click", () => show(number)));
  dialog.querySelector(".previous").addEventListener("click", () => show(shown - 1));
  dialog.querySelector(".next").addEventListener("click", () => show(shown + 1));
  dialog.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step) show(shown + step);
  });
  dialog.addEventListener("click", (event) => {
    if (event.target.closest("form, .caption")) return;
    if (event.target !== large || !dialog.classList.contains("shrunk")) return dialog.close();
    dialog.classList.add("natural");
    look();
  });
};

// On paper nothing unfolds: what is short is printed open, tables of hundreds of rows only if they are open.
const unfoldForPrint = () => {
  let unfolded = [];
  addEventListener("beforeprint", () => {
    unfolded = [...document.querySelectorAll("main details:not([open], .long, td details)")];
    for (const one of unfolded) one.open = true;
  });
  addEventListener("afterprint", () => {
    for (const one of unfolded) one.open = false;
  });
};

// The riser of the first screen plays once, again at a click, and not for those who want no motion.
const playOnce = () => {
  const svg = document.querySelector("svg.moving-riser");
  if (!svg) return;
  const replay = document.querySelector(".replay");
  replay.hidden = false;
  replay.addEventListener("click", () => {
    svg.unpauseAnimations();
    svg.setCurrentTime(0);
  });
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) {
    svg.setCurrentTime(60);
    svg.pauseAnimations();
  }
};

// The contents mark the chapter in view; the date is that of the file.
const markThePlace = () => {
  const written = document.querySelector(".written");
  if (written) written.textContent = `Page of ${new Date(document.lastModified).toISOString().slice(0, 10)}.`;
  const watcher = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) {
        document.querySelector(`.contents a[href="#${target.id}"]`)?.classList.toggle("here", isIntersecting);
      }
    },
    { rootMargin: "-40% 0px -55% 0px" },
  );
  for (const section of document.querySelectorAll("main section[id]")) watcher.observe(section);
};

// Contents stand at the side where there is room, else they are folded.
if (matchMedia("(max-width: 75rem)").matches) document.querySelector(".contents details").open = false;

// Plotly rejects the promise of an animation that another one interrupts, without a reason; nobody waits
// for it, and the browser would complain.
window.addEventListener("unhandledrejection", (event) => {
  if (event.reason === undefined) event.preventDefault();
});

// Calls show or hide as elements come within a distance of the view or leave it.
const watch = (selector, distance, show, hide) => {
  const watcher = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) (isIntersecting ? show : hide)(target);
    },
    { rootMargin: distance },
  );
  for (const element of document.querySelectorAll(selector)) watcher.observe(element);
};

// Browsers keep what they decode of an image until memory is short, hundreds of megabytes of a page like
// this. On screens each figure's image is drawn by a canvas, whose memory is let go far from the view.
const drawPicturesNearTheView = () => {
  for (const picture of document.querySelectorAll(".enlarge img")) {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = 0;
    canvas.style.aspectRatio = `${picture.getAttribute("width")} / ${picture.getAttribute("height")}`;
    canvas.style.width = `${picture.getAttribute("width")}px`;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", picture.alt);
    picture.before(canvas);
  }
  const draw = async (figure) => {
    const [canvas, picture] = figure.querySelectorAll("canvas, img");
    figure.dataset.near = "yes";
    const bitmap = await createImageBitmap(await (await fetch(picture.src)).blob());
    if (figure.dataset.near) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
      canvas.getContext("2d").drawImage(bitmap, 0, 0);
    }
    bitmap.close();
  };
  const putAway = (figure) => {
    if (!figure.dataset.near) return;
    delete figure.dataset.near;
    const canvas = figure.querySelector("canvas");
    canvas.width = canvas.height = 0;
  };
  document.documentElement.classList.add("drawn");
  watch("figure:has(> .enlarge)", "600px", draw, putAway);
};

// A run is drawn when it comes into view, and put away when it is far.
const drawRunsInMotion = () => {
  const narrow = matchMedia("(max-width: 45rem)");
  let plotly;
  const load = async () => {
    const script = document.createElement("script");
    script.textContent = await unpacked("plotly");
    document.head.append(script);
  };
  const draw = async (place) => {
    if (place.dataset.wanted) return;
    place.dataset.wanted = "yes";
    await (plotly ??= load());
    const figure = JSON.parse(await unpacked(`${place.id}-figure`));
    await Plotly.newPlot(place, figure.data, figure.layout, { responsive: true, displayModeBar: false });
    if (narrow.matches) await Plotly.update(place, figure.narrow.riser, figure.narrow.layout, [1]);
    await Plotly.addFrames(place, figure.frames);
    place.dataset.ready = "yes";
  };
  const putAway = (place) => {
    if (!place.dataset.ready) return;
    Plotly.purge(place);
    delete place.dataset.ready;
    delete place.dataset.wanted;
  };
  watch(".motion", "300px", draw, () => {});
  watch(".motion", "4000px", () => {}, putAway);
};

playOnce();
markThePlace();
enlargeFigures();
unfoldForPrint();
drawPicturesNearTheView();
drawRunsInMotion();
followLinks(letBarsFilter(await makeTablesSortable()));
