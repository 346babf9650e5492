#include "records/formats/detail/column_title.hpp"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "records/detail/text.hpp"
#include "records/formats/detail/rotation_title.hpp"

namespace musim::records::detail {
namespace {

// lists of words in small letters, between blanks
constexpr std::string_view kTimeWords =
    " time zeit temps tempo tiempo tid czas zaman tijd timestamp tmstamp datetime date datum fecha utc clock uhrzeit hora elapsed seconds "
    "\xE6\x97\xB6\xE9\x97\xB4 \xE6\x99\x82\xE9\x96\x93 \xE6\x97\xB6\xE5\x88\xBB \xE6\x99\x82\xE5\x88\xBB "
    "\xD0\xB2\xD1\x80\xD0\xB5\xD0\xBC\xD1\x8F \xD0\x92\xD1\x80\xD0\xB5\xD0\xBC\xD1\x8F ";
constexpr std::string_view kIndexWords =
    " index idx sample samples scan scans no nr num number counter point points pt pts id row record recnbr rec n i k # step steps seq "
    "sequence line item entry frame ";
constexpr std::string_view kAccelerationWords =
    " acc acel accel accx accy accz ax ay az acceleration accelerations accelerometer beschleunigung beschl aceleracion accelerazione "
    "ivme "
    "acel\xC3\xA9ration acc\xC3\xA9l\xC3\xA9ration aceleraci\xC3\xB3n "
    "\xE5\x8A\xA0\xE9\x80\x9F\xE5\xBA\xA6 ";
constexpr std::string_view kVelocityWords =
    " vel velx vely velz vx vy vz velocity velocities speed geschwindigkeit velocidad vitesse velocita "
    "\xE9\x80\x9F\xE5\xBA\xA6 ";
constexpr std::string_view kDisplacementWords =
    " weg dis disp dispx dispy dispz displ displacement displacements verschiebung desplazamiento spostamento deplacement "
    "d\xC3\xA9placement \xE5\xA4\x89\xE4\xBD\x8D \xE4\xBD\x8D\xE7\xA7\xBB ";
constexpr std::string_view kMagnitudeWords = " absolute magnitude resultant norm abs total vector modulus mag sum ";
constexpr std::string_view kRemarkWords =
    " temperature temp battery batt comment comments event marker trigger status flag humidity pressure latitude longitude lat lon gps "
    "note "
    "notes label quality force voltage rpm strain ";
constexpr std::string_view kBracketNotes =
    " n e w z x y ns ew ud n-s e-w u-d nw se up down vert vertical hor horiz horizontal h1 h2 long lateral trans transverse radial l r t i "
    "k filtered unfiltered corrected uncorrected processed rel relative abs absolute total avg average mean smp base ground top roof table "
    "north south east west input output left right front rear ";
constexpr std::string_view kEmptyUnits = " - -- --- ts rn smp none n/a na n.a. 1 [-] avg max unit units std ";
constexpr std::string_view kPeakWords = " pga pgv pgd peak peaks max maximum min minimum ";
constexpr std::string_view kSampleWords = " data value values sample samples amplitude amplitudes ordinate ordinates signal ";
constexpr std::string_view kNoUnits = " si metric imperial unknown ";

bool is_in(std::string_view words, std::string_view word) {
    return !word.empty() && word.find(' ') == std::string_view::npos && words.find(' ' + std::string(word) + ' ') != std::string_view::npos;
}

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    for (char& letter : small) letter = to_lower(letter);
    return small;
}

bool is_letter(char letter) { return (to_lower(letter) >= 'a' && to_lower(letter) <= 'z') || (letter & '\x80') != 0; }
bool is_capital(char letter) { return letter >= 'A' && letter <= 'Z'; }

/// Words of a name in small letters: "LinAccX_2" is lin, acc, x.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    bool goes_on = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!is_letter(text[i]) && text[i] != '#') {
            goes_on = false;
            continue;
        }
        if (i > 0 && is_capital(text[i]) && is_letter(text[i - 1]) && !is_capital(text[i - 1])) goes_on = false;
        if (!goes_on) words.emplace_back();
        words.back() += to_lower(text[i]);
        goes_on = true;
    }
    return words;
}

bool has_time_word(const std::vector<std::string>& words) {
    return words == std::vector<std::string>{"t"} || words == std::vector<std::string>{"x", "value"} || has_word(words, kTimeWords) ||
           std::any_of(words.begin(), words.end(), [](const std::string& word) { return word.ends_with("time"); });
}

/// The quantities that words name, each once.
std::vector<SampleQuantity> quantities_of(std::string_view text) {
    const std::vector<std::string> words = words_of(text);
    std::vector<SampleQuantity> found;
    // a letter alone is a quantity as a whole title: "a", "v(t)"
    if (words.size() == 1 && !text.empty() && text.front() == words.front().front()) {
        if (words.front() == "a") return {SampleQuantity::acceleration};
        if (words.front() == "v") return {SampleQuantity::velocity};
        if (words.front() == "d") return {SampleQuantity::displacement};
    }
    if (has_word(words, kAccelerationWords)) found.push_back(SampleQuantity::acceleration);
    if (has_word(words, kVelocityWords)) found.push_back(SampleQuantity::velocity);
    if (has_word(words, kDisplacementWords)) found.push_back(SampleQuantity::displacement);
    const RotationWords turn = read_rotation_words(words, found.size() == 1 ? std::optional(found.front()) : std::nullopt);
    if (!turn.is_rotation) return found;
    return turn.quantity ? std::vector{*turn.quantity} : std::vector<SampleQuantity>();
}

RotationWords rotation_words_of(std::string_view text) {
    const std::vector<SampleQuantity> named = quantities_of(text);
    const bool is_translation = named.size() == 1 && !is_rotation(named.front());
    return read_rotation_words(words_of(text), is_translation ? std::optional(named.front()) : std::nullopt);
}

std::optional<SampleQuantity> quantity_of(std::string_view text) {
    const std::vector<SampleQuantity> found = quantities_of(text);
    return found.size() == 1 ? std::optional(found.front()) : std::nullopt;
}

/// Meaning of a text as the unit of what is called `name`: "ns" is a unit of times, and a direction elsewhere.
ColumnUnit read_unit_of(std::string_view name, std::string_view text) {
    if (trim(text) == "ns" && has_time_word(words_of(name))) return {.seconds = 1e-9};
    return read_column_unit(text);
}

/// A text in brackets, and where it stands with them.
struct Bracketed {
    std::size_t first = 0;
    std::size_t last = 0;  ///< of the closing bracket; of the text where it is missing
    std::string_view text = {};
};

/// The outermost brackets of a text: "a (N-S) [m/(s^2)]" has two.
std::vector<Bracketed> find_brackets(std::string_view text) {
    constexpr std::string_view kOpen = "([{<", kClose = ")]}>";
    std::vector<Bracketed> found;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t kind = kOpen.find(text[i]);
        if (kind == std::string_view::npos) continue;
        std::size_t depth = 0, end = i;
        for (; end < text.size(); ++end) {
            if (text[end] == kOpen[kind]) ++depth;
            if (text[end] == kClose[kind] && --depth == 0) break;
        }
        if (end == text.size()) break;
        found.push_back({i, end, trim(text.substr(i + 1, end - i - 1))});
        i = end;
    }
    return found;
}

bool is_bracket_note(std::string_view text) {
    const std::string small = in_small_letters(text);
    const bool has_number =
        std::any_of(small.begin(), small.end(), is_digit) && small.find_first_of("/^*") == std::string::npos && !find_sample_unit(text);
    // "x 0.001 g" is a unit times a number
    const std::size_t last = small.rfind(' ');
    const std::optional<SampleUnit> unit = last == std::string::npos ? std::nullopt : find_sample_unit(small.substr(last + 1));
    if (has_number && unit && unit->quantity == SampleQuantity::acceleration) return false;
    constexpr std::size_t kLongestUnit = 14;  // letters; longer texts explain
    return small.empty() || has_number || text.size() > kLongestUnit || is_in(kBracketNotes, small);
}

/// A text with brackets as ASCII has them, for the wide ones of Chinese and Japanese titles.
std::string with_plain_brackets(std::string_view text) {
    constexpr std::pair<std::string_view, char> kWide[] = {
        {"\xEF\xBC\x88", '('}, {"\xEF\xBC\x89", ')'}, {"\xEF\xBC\xBB", '['},
        {"\xEF\xBC\xBD", ']'}, {"\xE3\x80\x90", '['}, {"\xE3\x80\x91", ']'},
    };
    std::string plain(text);
    for (const auto& [wide, bracket] : kWide) {
        for (std::size_t at = plain.find(wide); at != std::string::npos; at = plain.find(wide, at))
            plain.replace(at, wide.size(), 1, bracket);
    }
    return plain;
}

/// A name without what is left when its unit is taken out, fit for one cell of a CSV.
std::string tidy_name(std::string_view text) {
    std::string name;
    for (const char letter : text) {
        const bool is_gap = is_blank(letter) || letter == ',' || letter == ';' || letter == '"' || (letter >= 0 && letter < ' ');
        if (!is_gap) name += letter;
        if (is_gap && !name.empty() && name.back() != ' ') name += ' ';
    }
    const auto is_leftover = [](char letter) { return std::string_view(" /_:|-=").find(letter) != std::string_view::npos; };
    while (!name.empty() && is_leftover(name.back())) name.pop_back();
    while (!name.empty() && is_leftover(name.front())) name.erase(name.begin());
    if (name.ends_with(" in")) name.resize(name.size() - 3);
    const bool is_plain = std::all_of(name.begin(), name.end(), [](char letter) { return letter >= ' ' && letter <= '~'; });
    return is_plain ? name : printable(name);
}

void take_unit(ColumnTitle& title, const ColumnUnit& unit, std::string_view text) {
    const auto worth = [](const ColumnUnit& u) {
        return std::tuple(u.motion ? u.motion->si : 0.0, u.seconds.value_or(0.0), std::string_view(u.foreign));
    };
    if (title.unit.is_known() && worth(title.unit) != worth(unit)) title.unknown_unit = text;
    if (!title.unit.is_known()) title.unit = unit;
}

/// Units in brackets; the rest is the name. What stands in brackets and is neither a unit nor a note is an unknown unit.
void take_bracketed_units(ColumnTitle& title) {
    const std::string plain = with_plain_brackets(title.text);
    const std::string_view rest = plain;
    std::size_t taken = 0;
    std::string name, unknown;
    const std::vector<Bracketed> groups = find_brackets(rest);
    const bool has_motion =
        std::any_of(groups.begin(), groups.end(), [](const Bracketed& g) { return find_sample_unit(g.text).has_value(); });
    for (const Bracketed& group : groups) {
        const ColumnUnit unit = read_unit_of(rest.substr(0, group.first), group.text);
        const bool is_direction = is_in(kBracketNotes, in_small_letters(group.text)) && !unit.motion && !unit.seconds;
        // "Acc (V) [m/s2]" is vertical
        const bool is_letter_beside_unit = has_motion && !unit.motion && group.text.size() == 1;
        if (unit.is_known() && !is_direction && !is_letter_beside_unit) {
            take_unit(title, unit, group.text);
            name += rest.substr(taken, group.first - taken);
            name += ' ';
            taken = group.last + 1;
        } else if (!is_bracket_note(group.text)) {
            unknown = group.text;
        }
    }
    if (!title.unit.is_known() && title.unknown_unit.empty()) title.unknown_unit = unknown;
    title.name = name + std::string(rest.substr(taken));
}

/// Is a unit that ends a name without brackets meant as one? "acc_g" yes, "channel m" no.
bool is_meant(const ColumnUnit& unit, std::string_view text, char separator, std::string_view head) {
    const bool is_parted = std::string_view("/,:|=").find(separator) != std::string_view::npos;
    if (unit.seconds) return has_time_word(words_of(head));
    if (!unit.motion) return is_parted || (text.size() > 1 && (unit.foreign == "a voltage" || !quantity_of(head)));
    const std::optional<SampleQuantity> named = quantity_of(head);
    if (named == unit.motion->quantity) return true;
    if (named || has_time_word(words_of(head))) return false;
    if (unit.motion->quantity == SampleQuantity::displacement) return is_parted || unit.motion->name == "mm" || unit.motion->name == "cm";
    return is_parted || text.size() > 1 || separator == '_' || is_in(kBracketNotes, in_small_letters(head));
}

constexpr std::string_view kUnitSeparators = "_/,:|=-.* ";

/// A unit behind a separator or " in "; the longest that is one.
bool take_suffix_unit(ColumnTitle& title) {
    const std::string text = title.name;
    for (std::size_t at = text.find_first_of(kUnitSeparators); at != std::string::npos; at = text.find_first_of(kUnitSeparators, at + 1)) {
        const std::string_view whole = text;
        const std::string_view head = trim(whole.substr(0, at)), tail = trim(whole.substr(at + 1));
        const std::string_view unit_text = tail.starts_with("in ") && tail.size() > 3 ? tail.substr(3) : tail;
        const ColumnUnit unit = read_unit_of(head, unit_text);
        if (head.empty() || !unit.is_known() || !is_meant(unit, unit_text, text[at], head)) continue;
        title.unit = unit;
        title.name = std::string(head);
        return true;
    }
    return false;
}

/// A unit that a word of accelerations ends with: "accG", "ACCmg", "acc%g".
bool take_joined_unit(ColumnTitle& title) {
    constexpr std::size_t kShortestWord = 3;
    const std::string_view text = title.name;
    for (std::size_t size = kShortestWord; size < text.size(); ++size) {
        if (!is_in(kAccelerationWords, in_small_letters(text.substr(0, size)))) continue;
        const ColumnUnit unit = read_column_unit(text.substr(size));
        if (!unit.motion || unit.motion->quantity != SampleQuantity::acceleration) continue;
        title.unit = unit;
        title.name.resize(size);
        return true;
    }
    return false;
}

/// A unit before a direction: "acc_g_x", "cm/s^2 NS".
void take_inner_unit(ColumnTitle& title) {
    const std::string text(trim(title.name));
    const std::size_t at = text.find_last_of("_:- ");
    if (at == std::string::npos || at == 0) return;
    ColumnTitle head{.name = std::string(trim(std::string_view(text).substr(0, at)))};
    const std::string tail(trim(std::string_view(text).substr(at + 1)));
    if (!tail.empty() && !is_in(kBracketNotes, in_small_letters(tail))) return;
    const ColumnUnit whole = read_column_unit(head.name);
    // "g_x" may be a rotation rate, "mm NS" is a displacement
    if (whole.motion && head.name.size() > 1 && whole.motion->quantity == SampleQuantity::acceleration) {
        head.unit = whole;
        head.name.clear();
    } else if (!take_suffix_unit(head) || !head.unit.motion) {
        return;
    }
    title.unit = head.unit;
    title.name = head.name + ' ' + tail;
}

/// A title that is nothing but a unit; what may be a name is none.
bool is_unit_alone(const ColumnUnit& unit, std::string_view text) {
    constexpr std::string_view kNames = " m in ft h hr min mins ";
    return !is_in(kNames, in_small_letters(text)) && text != "S" && (unit.motion || unit.seconds || text.size() > 1);
}

/// The unit of time that is a word of a name: "seconds_elapsed".
std::optional<double> find_seconds_of_words(const std::vector<std::string>& words) {
    constexpr std::size_t kShortestWord = 3;
    for (const std::string& word : words) {
        const std::optional<double> seconds = word.size() >= kShortestWord && word != "min" ? read_column_unit(word).seconds : std::nullopt;
        if (seconds) return seconds;
    }
    return std::nullopt;
}

void judge(ColumnTitle& title) {
    const std::vector<std::string> words = words_of(title.name);
    const RotationWords turn = rotation_words_of(title.name);
    if (title.unit.motion && is_rotation(title.unit.motion->quantity)) {
        // "Latitude (deg)" is no motion
        if (turn.is_bearing) title.unit = {.foreign = "a bearing"};
    } else if (title.unit.motion && turn.is_certain) {
        title.unknown_unit = title.unit.motion->name;
    }
    const std::vector<SampleQuantity> named = quantities_of(title.name);
    if (named.size() == 1) title.quantity = named.front();
    if (title.unit.motion && title.quantity && *title.quantity != title.unit.motion->quantity) title.unknown_unit = title.unit.motion->name;
    if (title.unit.seconds && title.quantity) title.unknown_unit = "of time";
    if (title.unit.motion) title.quantity = title.unit.motion->quantity;
    title.is_time = !title.quantity && !title.unit.motion && title.unit.foreign.empty() && (title.unit.seconds || has_time_word(words));
    if (title.is_time && !title.unit.seconds) title.unit.seconds = find_seconds_of_words(words);
    title.is_index = !title.quantity && !title.unit.is_known() && !title.is_time && !words.empty() &&
                     std::all_of(words.begin(), words.end(), [](const std::string& word) { return is_in(kIndexWords, word); });
    title.is_magnitude = has_word(words, kMagnitudeWords);
    title.is_rotation = title.quantity ? is_rotation(*title.quantity) : turn.is_rotation;
    title.is_remark = !title.quantity && has_word(words, kRemarkWords);
}

}  // namespace

ColumnTitle read_column_title(std::string_view text) {
    ColumnTitle title{.text = std::string(trim(text))};
    take_bracketed_units(title);
    if (!title.unit.is_known() && title.unknown_unit.empty()) {
        const ColumnUnit whole = read_column_unit(title.name);
        if (whole.is_known() && is_unit_alone(whole, trim(title.name))) {
            title.unit = whole;
            title.name.clear();
        } else if (!take_suffix_unit(title) && !take_joined_unit(title)) {
            take_inner_unit(title);
        }
    }
    title.name = tidy_name(title.name);
    judge(title);
    return title;
}

bool is_empty_unit(std::string_view text) {
    const std::string small = plain_unit_text(text);
    return small.empty() || is_in(kEmptyUnits, small) || small.find("unit") != std::string::npos;
}

void add_unit(ColumnTitle& title, std::string_view unit_text) {
    if (is_empty_unit(unit_text)) return;
    const ColumnUnit unit = read_column_unit(unit_text);
    if (unit.is_known()) {
        take_unit(title, unit, unit_text);
    } else {
        title.unknown_unit = trim(unit_text);
    }
    judge(title);
}

namespace {

/// The text behind "unit:", "Units =", "Y_Unit_Label<tab>", "units of", "units are"; nothing when the line states no unit by that word.
std::optional<std::string_view> find_text_behind_unit(std::string_view line) {
    for (std::size_t at = 0; at < line.size(); ++at) {
        if (at > 0 && is_letter(line[at - 1])) continue;
        std::string_view rest = line.substr(at);
        for (const std::string_view word : {"units", "unit", "einheit", "unidades", "unidad", "birim"}) {
            if (find_ignoring_case(rest.substr(0, word.size()), word) != 0) continue;
            rest.remove_prefix(word.size());
            break;
        }
        if (rest.size() == line.size() - at) continue;
        for (const std::string_view label : {"_label", " label", " of", " are", " is", " in"}) {
            if (find_ignoring_case(rest, label) != 0) continue;
            rest.remove_prefix(label.size());
            if (label[0] == ' ' && label != " label") return trim(rest);
        }
        // "units g"
        std::string_view words = rest;
        if (!rest.empty() && is_blank(rest.front()) && read_column_unit(take_token(words)).is_known()) return trim(rest);
        // "units - g"
        if (const std::string_view behind = trim(rest); behind.starts_with("- ") && read_column_unit(behind.substr(2)).is_known())
            return trim(behind.substr(2));
        const std::size_t mark = rest.find_first_not_of(" \"");
        if (mark == std::string_view::npos || std::string_view(":=\t,;").find(rest[mark]) == std::string_view::npos) continue;
        return trim(rest.substr(mark + 1));
    }
    return std::nullopt;
}

void state(UnitStatement& statement, const ColumnUnit& unit, std::string_view text) {
    if (unit.seconds) statement.seconds = unit.seconds;
    if (!unit.foreign.empty()) statement.unknown = text;
    if (!unit.motion) return;
    std::optional<SampleUnit>& stated = is_rotation(unit.motion->quantity) ? statement.rotation : statement.motion;
    if (stated && (stated->si != unit.motion->si || stated->quantity != unit.motion->quantity)) {
        statement.unknown = std::string(stated->name) + "' and '" + std::string(unit.motion->name);
    }
    if (!stated) stated = unit.motion;
}

void read_listed_units(std::string_view text, UnitStatement& statement) {
    bool is_any_known = false;
    std::string_view first_unknown;
    while (!text.empty()) {
        const std::string_view piece = trim(take_token(text, ",;\t&|\""));
        const std::string_view word = trim(piece.substr(0, piece.find_first_of("([")));
        if (word.empty()) continue;
        ColumnUnit unit = read_column_unit(word);
        if (!unit.is_known()) unit = read_column_title(piece).unit;
        if (unit.is_known()) {
            is_any_known = true;
            state(statement, unit, piece);
        } else if (first_unknown.empty() && !is_in(kNoUnits, in_small_letters(word))) {
            first_unknown = piece;
        }
    }
    if (!is_any_known && !statement.motion && !statement.rotation && !first_unknown.empty()) statement.unknown = first_unknown;
}

}  // namespace

UnitStatement read_unit_statement(std::string_view line) {
    UnitStatement statement{.quantity = quantity_of(line)};
    // a peak may stand in another unit than the samples
    const bool speaks_of_peak = has_word(words_of(line), kPeakWords);
    if (speaks_of_peak && !find_text_behind_unit(line)) return {};
    // "azimuth (deg)" is no motion
    const bool speaks_of_rotation = rotation_words_of(line).is_rotation;
    const auto is_of_samples = [&](const ColumnUnit& unit) {
        return unit.motion && (speaks_of_rotation || !is_rotation(unit.motion->quantity));
    };
    for (const Bracketed& group : find_brackets(line)) {
        const ColumnUnit unit = read_column_unit(group.text);
        if (is_of_samples(unit)) state(statement, unit, group.text);
        const std::vector<std::string> before = words_of(line.substr(0, group.first));
        if (unit.seconds && !before.empty() && has_time_word({before.back()})) statement.seconds = unit.seconds;
    }
    if (const std::optional<std::string_view> text = find_text_behind_unit(line)) {
        statement.is_explicit = true;
        read_listed_units(*text, statement);
        return statement;
    }
    if (statement.motion || statement.rotation) return statement;

    // "acceleration in g", "velocity in cm/s at the base", "Acceleration, g"
    for (std::size_t in = line.rfind(" in "); in != std::string_view::npos; in = in > 0 ? line.rfind(" in ", in - 1) : line.npos) {
        std::string_view tail = trim(line.substr(in + 4));
        const bool speaks_of_samples = has_word(words_of(line.substr(0, in)), kSampleWords);
        for (const std::string_view text : {tail, take_token(tail, " \t,;")}) {
            const ColumnUnit unit = read_column_unit(text);
            if (!is_of_samples(unit)) continue;
            if (unit.motion->name.size() > 1 || speaks_of_samples || statement.quantity == unit.motion->quantity) {
                state(statement, unit, text);
                return statement;
            }
        }
    }
    // a unit alone, or behind what stands for the samples
    const ColumnTitle title = read_column_title(line);
    const bool speaks_of_samples = title.name.empty() || has_word(words_of(title.name), kSampleWords);
    const bool is_stated = speaks_of_samples || statement.quantity == (title.unit.motion ? title.unit.motion->quantity : title.quantity);
    if (is_of_samples(title.unit) && is_stated) state(statement, title.unit, title.text);
    return statement;
}

}  // namespace musim::records::detail
