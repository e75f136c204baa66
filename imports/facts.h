// Facts not contained in the file itself: `--with key=value`, else lines above its table.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "geometry/axes.h"
#include "imports/text_table.h"
#include "setup/setup.h"

namespace trunnion::imports {

/// Facts of one import; the keys of each kind are in docs/readings.md.
class Facts {
  public:
    /// `told`: "key=value" each. Throws InputError for a text without `=`, an unknown key, and a
    /// duplicate key.
    explicit Facts(const std::vector<std::string>& told);
    /// These facts, completed by those of the head lines of a file.
    Facts with_head_of(const TextTable& table) const;

    bool has(const std::string& key) const { return facts_.contains(key); }
    bool is_told(const std::string& key) const { return told_.contains(key); }  ///< by `--with`
    std::string text(const std::string& key, const std::string& otherwise = "") const;
    /// A number above 0; throws InputError for any other text.
    std::optional<double> positive(const std::string& key) const;
    std::optional<double> number(const std::string& key) const;

  private:
    std::map<std::string, std::string> facts_;
    std::set<std::string> told_;
};

/// The axis named `name` ("X", "x", "X1", "X-axis", "J1"); empty when the machine does not have it.
std::optional<Axis> axis_named(const setup::Setup& setup, const std::string& name);
/// True for a rotary axis; the machine's own axis may be rotary although its letter is that of a
/// slide.
bool turns(const setup::Setup& setup, Axis axis);
/// "Y=100 B=-30" (mm, deg): positions of axes not contained in the file. Throws InputError for an
/// axis that the machine does not have.
AxisPositions positions_told(const setup::Setup& setup, const std::string& text);
/// The artefact of this kind named `feature`, or the only one. Throws InputError with the missing
/// item and the setup.
const setup::Artefact& artefact_for(const setup::Setup& setup, const std::string& feature,
                                    setup::Artefact::Kind kind);

}  // namespace trunnion::imports
