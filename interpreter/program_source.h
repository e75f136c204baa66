// Source of programs: the only interface of the language to the outside world.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace trunnion::interpreter {

/// The bytes of one file when it was read, shared by all users.
struct ProgramText {
    std::string name;  ///< path as given, for messages
    std::string_view text;
    std::shared_ptr<const void> owner;
};

class ProgramSource {
  public:
    virtual ~ProgramSource() = default;
    /// The file that contains program O`number`; empty if none.
    virtual std::optional<ProgramText> find(int o_number) = 0;
    /// The file that contains the program `<name>` (without the brackets); empty if none.
    virtual std::optional<ProgramText> find(std::string_view name) = 0;
};

/// Programs in memory, for tests and for callers without files.
class ProgramsInMemory : public ProgramSource {
  public:
    void add(int o_number, std::string text);
    std::optional<ProgramText> find(int o_number) override;
    std::optional<ProgramText> find(std::string_view name) override;

  private:
    std::map<int, std::shared_ptr<const std::string>> programs_;
};

}  // namespace trunnion::interpreter
