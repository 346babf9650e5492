// What every report does beside its blocks: on paper the numbers of all plots are there.
"use strict";
(function () {
  window.addEventListener("beforeprint", function () {
    document.querySelectorAll("figure details").forEach(function (details) { details.open = true; });
  });
})();
