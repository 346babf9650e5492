#pragma once

#include <stdexcept>

namespace musim::records {

/// A file that is no usable record. The message is one line, `path:line: what (why); what to do`.
class ReadError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A file that could not be written; nothing is left in its place. The message is one line, `path: what (why); what to do`.
class WriteError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A series or a setting that a processing step cannot work with; the message says which and what to change.
class ProcessingError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace musim::records
