// What the file itself does not tell: `--with key=value`, else lines above its table.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "geometry/axes.h"
#include "imports/text_table.h"
#include "setup/setup.h"

namespace trunnion::imports {

/// One import: the keys that its kind knows are in docs/readings.md.
class Facts {
  public:
    /// `told`: "key=value" each. Throws InputError for a text without `=`, a key that no import
    /// has, and a key told twice.
    explicit Facts(const std::vector<std::string>& told);
    /// These facts, and beside them those that the head lines of a file tell.
    Facts with_head_of(const TextTable& table) const;

    bool has(const std::string& key) const { return facts_.contains(key); }
    std::string text(const std::string& key, const std::string& otherwise = "") const;
    /// A number above 0; throws InputError for another text.
    std::optional<double> positive(const std::string& key) const;
    std::optional<double> number(const std::string& key) const;

  private:
    std::map<std::string, std::string> facts_;
};

/// The axis that `name` says ("X", "x", "X1", "X-axis", "J1"); nothing when the machine has none
/// such.
std::optional<Axis> axis_named(const setup::Setup& setup, const std::string& name);
/// The machine's own axis may turn under the letter of a slide.
bool turns(const setup::Setup& setup, Axis axis);
/// "Y=100 B=-30" (mm, deg): positions of axes that the file does not tell. Throws InputError for
/// an axis that the machine does not have.
AxisPositions positions_told(const setup::Setup& setup, const std::string& text);
/// The artefact of these kinds that `feature` names, or the only one there is. Throws InputError
/// that says which setup lacks what.
const setup::Artefact& artefact_for(const setup::Setup& setup, const std::string& feature,
                                    setup::Artefact::Kind kind);

}  // namespace trunnion::imports
