#pragma once

/// Files of lsdem/report/web, as text; made part of the program when it is built.
namespace musim::lsdem {

extern const char* const kReportStyle;   ///< report.css
extern const char* const kReportScript;  ///< report.js
extern const char* const kTowerScript;   ///< tower_*.js and tower.js
extern const char* const kThreeFolder;   ///< where three.min.js lies (Debian's libjs-three)

}  // namespace musim::lsdem
