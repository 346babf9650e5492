#include "lsdem/mesh/detail/mesh_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "lsdem/mesh/detail/mesh_making.hpp"
#include "scaling/shorten.hpp"

namespace musim::lsdem::detail {
namespace {

constexpr std::string_view kMeshBlanks = " \t\v\f";
constexpr std::string_view kMeshSpaces = " \t\v\f\r\n";

}  // namespace

void MeshWords::fail(const std::string& problem, const std::string& remedy) const { fail_mesh(*file_, line_, problem, remedy); }

bool MeshWords::skip_line_end() {
    if (offset_ >= bytes_.size() || (bytes_[offset_] != '\n' && bytes_[offset_] != '\r')) return false;
    const bool two = bytes_[offset_] == '\r' && offset_ + 1 < bytes_.size() && bytes_[offset_ + 1] == '\n';
    offset_ += two ? 2 : 1;
    ++line_;
    return true;
}

std::string_view MeshWords::take_word() {
    const std::size_t first = offset_;
    while (offset_ < bytes_.size() && kMeshSpaces.find(bytes_[offset_]) == std::string_view::npos) ++offset_;
    return bytes_.substr(first, offset_ - first);
}

std::string_view MeshWords::next() {
    while (offset_ < bytes_.size()) {
        if (skip_line_end()) continue;
        if (kMeshBlanks.find(bytes_[offset_]) == std::string_view::npos) return take_word();
        ++offset_;
    }
    return {};
}

std::string_view MeshWords::next_in_line() {
    while (offset_ < bytes_.size()) {
        const char c = bytes_[offset_];
        if (c == '\n' || c == '\r' || c == '#') return {};
        if (c == '\\') {
            ++offset_;
            if (skip_line_end()) continue;
            --offset_;
        }
        if (kMeshBlanks.find(c) != std::string_view::npos) {
            ++offset_;
            continue;
        }
        // a line may be continued right behind a word
        const std::size_t first = offset_;
        std::string_view word = take_word();
        if (word.size() > 1 && word.back() == '\\' && offset_ < bytes_.size() && (bytes_[offset_] == '\n' || bytes_[offset_] == '\r')) {
            word.remove_suffix(1);
            offset_ = first + word.size();
        }
        return word;
    }
    return {};
}

std::string_view MeshWords::skip_line() {
    const std::size_t first = std::min(bytes_.find_first_not_of(kMeshBlanks, offset_), bytes_.size());
    offset_ = std::min(bytes_.find_first_of("\r\n", first), bytes_.size());
    std::string_view rest = bytes_.substr(first, offset_ - first);
    rest = rest.substr(0, rest.find_last_not_of(kMeshBlanks) + 1);
    skip_line_end();
    return rest;
}

bool is_word(std::string_view word, std::string_view lower) {
    return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char given, char wanted) {
        return (given >= 'A' && given <= 'Z' ? static_cast<char>(given - 'A' + 'a') : given) == wanted;
    });
}

std::string quote_word(std::string_view word) {
    return word.empty() ? "the file's end" : fmt::format("'{}'", scaling::shorten(word, scaling::kEchoed));
}

std::optional<long long> parse_whole(std::string_view word) {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    long long value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return value;
}

double parse_coordinate(const MeshWords& words, std::string_view word, std::string_view meaning) {
    std::string_view digits = word;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc() && end == digits.data() + digits.size() && std::isfinite(value)) return value + 0.0;  // -0 is 0
    words.fail(fmt::format("{} is {}, no finite number of a double", meaning, quote_word(word)), "correct the coordinate");
}

}  // namespace musim::lsdem::detail
