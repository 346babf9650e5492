#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace musim::lsdem::detail {

/// 64-bit FNV-1a hash of content that comes in pieces. A change of one byte always changes it; of other changes it misses 1 in 2^64.
class ContentHash {
  public:
    void add(std::string_view piece);
    /// 16 hexadecimal digits.
    std::string name() const;

  private:
    std::uint64_t hash_ = 14695981039346656037ULL;
};

/// Name for content: its ContentHash as 16 hexadecimal digits. Equal contents have equal names on every machine.
std::string name_content(std::string_view content);

}  // namespace musim::lsdem::detail
