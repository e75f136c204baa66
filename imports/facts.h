// Facts not contained in the file itself: `--with key=value`, else lines above its table.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/alarm.h"
#include "geometry/axes.h"
#include "imports/text_table.h"
#include "imports/units.h"
#include "setup/setup.h"

namespace trunnion::imports {

/// Facts of one import; the keys of each kind are in docs/readings.md.
class Facts {
  public:
    /// `told`: "key=value" each. Throws InputError for a text without `=`, an unknown key, and a
    /// duplicate key.
    explicit Facts(const std::vector<std::string>& told);
    /// These facts, completed by those of the head lines of a file. A note tells a line that
    /// `--with` says otherwise; throws InputError where both name another axis.
    Facts with_head_of(const TextTable& table, std::vector<std::string>& notes) const;

    bool has(const std::string& key) const { return facts_.contains(key); }
    /// Throws InputError at the line that tells this fact.
    [[noreturn]] void fail(const std::string& key, const std::string& message) const;
    bool is_told(const std::string& key) const { return told_.contains(key); }  ///< by `--with`
    std::string text(const std::string& key, const std::string& otherwise = "") const;
    /// A number above 0; throws InputError for any other text. In mm, rad, s, mm/s if `key` is of
    /// this quantity; `usual` is its unit where none is written.
    std::optional<double> positive(const std::string& key, Quantity quantity,
                                   const std::string& usual) const;
    std::optional<double> number(const std::string& key, Quantity quantity,
                                 const std::string& usual) const;

  private:
    struct Fact {
        std::string text;
        SourceRef where;  ///< the line that tells it
        std::string line;
        Dialect dialect;
    };
    static Fact told_by(const TextTable& table, const TextTable::HeadEntry& entry,
                        const std::string& text);
    void note_contradiction(const std::string& key, const Fact& fact,
                            std::vector<std::string>& notes) const;

    std::map<std::string, Fact> facts_;
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
