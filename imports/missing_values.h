// Values that a file does not have: counted, and told in one note.
#pragma once

#include <string>
#include <vector>

namespace trunnion::imports {

/// Counts values that are missing, and tells where.
class MissingValues {
  public:
    void add(int line, const std::string& column);
    /// Adds the note, if there are any.
    void note(const std::string& path, std::vector<std::string>& notes) const;

  private:
    std::size_t count_ = 0;
    std::string places_;
};

}  // namespace trunnion::imports
