#pragma once

#include "scaling/error.hpp"

namespace musim::records {

/// A file that is no usable record. The message is one line, `path:line: what (why); what to do`.
class ReadError : public Error {
  public:
    using Error::Error;
};

/// A file that could not be written; nothing is left in its place. The message is one line, `path: what (why); what to do`.
class WriteError : public Error {
  public:
    using Error::Error;
};

/// A series or a setting that a processing step cannot work with; the message says which and what to change.
class ProcessingError : public Error {
  public:
    using Error::Error;
};

}  // namespace musim::records
