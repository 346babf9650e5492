#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace musim::lsdem::detail {

/// The words of a text: what blanks part, on any lines. Lines end with LF, CR LF or CR.
class MeshWords {
  public:
    /// `file`: the name of the text in messages; both must outlive the words.
    MeshWords(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(&file) {}

    /// The next word; empty at the end.
    std::string_view next();

    /// The next word of the same line, or of the one that continues it (`\` at its end); empty at the line's end and before a `#`.
    std::string_view next_in_line();

    /// The rest of the line, without blanks around it.
    std::string_view skip_line();

    std::size_t line() const { return line_; }      ///< that of the last word, from 1
    std::size_t offset() const { return offset_; }  ///< bytes read so far
    const std::string& file() const { return *file_; }

    /// Throws MeshError with the line of the last word.
    [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;

  private:
    bool skip_line_end();
    std::string_view take_word();

    std::string_view bytes_;
    const std::string* file_;
    std::size_t offset_ = 0, line_ = 1;
};

/// Are two words the same, whatever the case of their letters? `lower` has small letters.
bool is_word(std::string_view word, std::string_view lower);

/// A word in quotes for a message, shortened; "the file's end" for none.
std::string quote_word(std::string_view word);

/// A whole number; none for other words and beyond 64 bits.
std::optional<long long> parse_whole(std::string_view word);

/// The finite number of a word, -0 as 0; fails for other words, nan and inf among them, with `meaning`, e.g. "x".
double parse_coordinate(const MeshWords& words, std::string_view word, std::string_view meaning);

}  // namespace musim::lsdem::detail
