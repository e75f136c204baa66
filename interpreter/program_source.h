// Where programs come from: the one small interface to the outside world.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::interpreter {

/// The bytes of one file as they were when it was read, kept alive as long as anyone uses them.
struct ProgramText {
    std::string name;  ///< shown in messages: the path as given
    std::string_view text;
    std::shared_ptr<const void> owner;
};

class ProgramSource {
  public:
    virtual ~ProgramSource() = default;
    /// The file that holds program O`number`, or nothing.
    virtual std::optional<ProgramText> find(int o_number) = 0;
    /// The file that holds the program called `<name>` (without the brackets), or nothing.
    virtual std::optional<ProgramText> find(std::string_view name) = 0;
};

/// Programs held in memory, for tests and for callers who have no files.
class ProgramsInMemory : public ProgramSource {
  public:
    void add(int o_number, std::string text);
    std::optional<ProgramText> find(int o_number) override;
    std::optional<ProgramText> find(std::string_view name) override;

  private:
    std::map<int, std::shared_ptr<const std::string>> programs_;
};

}  // namespace trunnion::interpreter
