// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace sofa::helper {

/// What components said, for tests to read.
struct Messages {
  std::vector<std::string> errors;
  std::vector<std::string> warnings;

  static Messages& all() {
    static Messages messages;
    return messages;
  }
};

/// Collects one message and hands it in when it is complete.
class MessageStream {
 public:
  explicit MessageStream(std::vector<std::string>& list) : m_list(list) {}
  MessageStream(const MessageStream&) = delete;
  MessageStream& operator=(const MessageStream&) = delete;
  MessageStream(MessageStream&&) = delete;
  MessageStream& operator=(MessageStream&&) = delete;
  ~MessageStream() { m_list.push_back(m_text.str()); }

  template <class T>
  MessageStream& operator<<(const T& value) {
    m_text << value;
    return *this;
  }

 private:
  std::vector<std::string>& m_list;
  std::ostringstream m_text;
};

}  // namespace sofa::helper

#define msg_error() ::sofa::helper::MessageStream(::sofa::helper::Messages::all().errors)
#define msg_warning() ::sofa::helper::MessageStream(::sofa::helper::Messages::all().warnings)
