// What every report does beside its blocks: a link to a figure opens its numbers for print.
"use strict";
(function () {
  window.addEventListener("beforeprint", function () {
    document.querySelectorAll("figure details").forEach(function (details) { details.open = true; });
  });
})();
