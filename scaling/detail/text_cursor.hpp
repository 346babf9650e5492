#pragma once

#include <string_view>

namespace musim::scaling::detail {

/// Rest of a text that is read from the front: the common part of recursive-descent readers.
class TextCursor {
  protected:
    explicit TextCursor(std::string_view text) : rest_(text) {}

    /// Takes `token` off the front if it is there.
    bool skip(std::string_view token) {
        if (!rest_.starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }

    void skip_blanks() {
        while (skip(" ") || skip("\t")) continue;
    }

    /// Whether a product ends here.
    bool at_end() const { return rest_.empty() || rest_.front() == ')'; }

    bool at_digit() const { return !rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9'; }

    std::string_view rest_;
};

}  // namespace musim::scaling::detail
