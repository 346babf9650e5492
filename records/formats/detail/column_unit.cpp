#include "records/formats/detail/column_unit.hpp"

#include <string>

namespace musim::records::detail {
namespace {

struct TimeUnit {
    double seconds;
    std::string_view names;  ///< between blanks
};

constexpr TimeUnit kTimeUnits[] = {
    {1.0, " s sec secs second seconds sek sekunde sekunden seg segs segundo segundos seconde secondes secondi sn "},
    {1e-3, " ms msec msecs msek millisec millisecs millisecond milliseconds millis "},
    {1e-6, " us usec usecs microsec microsecs microsecond microseconds micros "},
    {1e-9, " nsec nanosec nanosecond nanoseconds "},
    {60.0, " min mins minute minutes "},
    {3600.0, " h hr hrs hour hours "},
};

struct ForeignUnit {
    std::string_view noun;
    std::string_view names;  ///< between blanks
};

constexpr ForeignUnit kForeignUnits[] = {
    {"a voltage", " v mv uv nv kv volt volts millivolt millivolts microvolt microvolts voltage vdc vrms v/v mv/v "},
    {"counts", " count counts cnt cnts cts ct digit digits lsb adc bit bits du raw "},
    {"a current", " ma ua amp amps ampere amperes "},
    {"a temperature", " degc degf degrees_c celsius fahrenheit kelvin degk c "},
    {"a speed of rotation", " rpm "},
    {"a magnetic field", " ut mt nt tesla gauss mgauss "},
    {"a pressure", " pa hpa kpa mpa gpa bar mbar psi ksi atm torr mmhg n/mm2 "},
    {"a force", " n kn mn lbf kip kips kgf tonf "},
    {"a moment", " nm knm kn-m n-m kn*m n*m kip-ft kip-in "},
    {"a strain", " ustrain microstrain ue uepsilon strain m/m um/m "},
    {"a frequency", " hz khz mhz sps samples/s "},
    {"a level", " db "},
    {"a share", " % percent "},
};

bool is_among(std::string_view names, const std::string& name) { return names.find(' ' + name + ' ') != std::string_view::npos; }

}  // namespace

ColumnUnit read_column_unit(std::string_view text) {
    std::string name = plain_unit_text(text);
    if (name.starts_with("deg ")) name.erase(3, 1);  // "deg C"
    if (name.empty() || name.find(' ') != std::string::npos) return {.motion = find_sample_unit(text)};
    for (const TimeUnit& unit : kTimeUnits)
        if (is_among(unit.names, name)) return {.seconds = unit.seconds};
    if (std::optional<SampleUnit> unit = find_sample_unit(text)) return {.motion = unit};
    for (const ForeignUnit& unit : kForeignUnits)
        if (is_among(unit.names, name)) return {.foreign = unit.noun};
    return {};
}

}  // namespace musim::records::detail
