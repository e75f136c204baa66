#include "identification/set_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace trunnion::identification {
namespace {

using Kind = SetUpQuantity::Kind;

/// Items used by the device rows of a replay.
struct Used {
    std::set<int> artefacts, instruments;
    std::set<std::pair<bool, double>> extensions;  ///< of the stylus (true) or the cup
    std::set<Axis> encoders;
    bool bar = false;
};

Used used_by(const emulator::Replay& replay, std::size_t session) {
    Used used;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        if (replay.session(i) != session) continue;
        const emulator::Contact& contact = replay.contact(i);
        const bool bar = contact.device == records::Device::ballbar;
        used.artefacts.insert(contact.artefact);
        if (contact.device == records::Device::point)  // others have no pose
            used.instruments.insert(contact.instrument);
        if (contact.extension_mm != 0.0) used.extensions.insert({!bar, contact.extension_mm});
        if (contact.device == records::Device::axis) used.encoders.insert(contact.axis);
        used.bar = used.bar || bar;
    }
    return used;
}

void add_place(std::vector<FreeQuantity>& list, const std::string& owner, SetUpQuantity place) {
    for (place.component = 0; place.component < 3; ++place.component)
        list.push_back({owner + "." + "xyz"[place.component] + "_mm", "mm", 0.1, place});
}

void add_pose(std::vector<FreeQuantity>& list, const std::string& owner, SetUpQuantity place) {
    add_place(list, owner, place);
    for (place.component = 3; place.component < 6; ++place.component)
        list.push_back({owner + "." + "abc"[place.component - 3] + "_rad", "rad", 1e-4, place});
}

bool is_free(const setup::Artefact& artefact) {
    return artefact.tool_S_mm ? artefact.free_tool : artefact.free_center;
}

/// The quantity that a fit changes. The declared position of a target is kept, because its readings
/// are relative to it.
Vector3& place_of(setup::Artefact& artefact) {
    return artefact.kind == setup::Artefact::Kind::target ? artefact.found_mm
                                                          : artefact.center_W_mm;
}

Vector3& ball_of(setup::ExtensionErrors& errors, double extension_mm) {
    return errors.try_emplace(extension_mm, Vector3::Zero()).first->second;
}

double& number_of(setup::Instrument& instrument, int component) {
    if (component < 3) return instrument.pose_error.shift_mm(component);
    if (component < 6) return instrument.pose_error.tilt_rad(component - 3);
    return instrument.scale_error;
}

setup::ExtensionErrors difference(const setup::ExtensionErrors& from, setup::ExtensionErrors to) {
    for (auto& [length_mm, shift] : to)
        if (const auto it = from.find(length_mm); it != from.end()) shift -= it->second;
    return to;
}

double artefact_derivative(const SetUpQuantity& quantity, const emulator::Contact& contact,
                           const kinematics::Perturbation& gradient, bool on_tool) {
    if (contact.artefact != quantity.index) return 0.0;
    return (on_tool ? gradient.tip_shift_mm : gradient.work_shift_mm)(quantity.component);
}

/// First order about the pose error `at` of the setup: p' = shift + (1 + scale) exp([tilt]x) p.
double instrument_derivative(const SetUpQuantity& quantity, const emulator::Contact& contact,
                             const SmallMotion& at) {
    const Vector3 &p = contact.turned_I_mm, &along = contact.direction_I;
    if (quantity.component < 3) return along(quantity.component);
    if (quantity.component < 6)
        return p.cross(along).dot(turn_by(at.tilt_rad).col(quantity.component - 3));
    return along.dot(p);
}

bool is_read_by(const SetUpQuantity& encoder, const emulator::Contact& contact) {
    return contact.device == records::Device::axis &&
           index_of(contact.axis) == static_cast<std::size_t>(encoder.index);
}

}  // namespace

namespace {

/// "zero.X_mm", "zero.C_rad.tuesday"
void add_zeros(std::vector<FreeQuantity>& list, const emulator::Replay& replay) {
    for (std::size_t k = 0; k < replay.zeros().size(); ++k) {
        const emulator::ZeroGroup& group = replay.zeros()[k];
        const std::string name = "zero." + group.test + (group.angular ? "_rad" : "_mm") +
                                 (group.session.empty() ? "" : '.' + group.session);
        list.push_back({name,
                        group.angular ? "rad" : "mm",
                        group.angular ? 1e-4 : 0.1,
                        {Kind::zero, static_cast<int>(k)}});
    }
}

}  // namespace

namespace {

/// The quantities observable in one session.
std::vector<FreeQuantity> quantities_of(const setup::Setup& setup, const Used& used) {
    std::vector<FreeQuantity> list;
    for (int k = 0; k < static_cast<int>(setup.artefacts.size()); ++k) {
        const setup::Artefact& artefact = setup.artefacts[static_cast<std::size_t>(k)];
        if (used.artefacts.contains(k) && is_free(artefact))
            add_place(list, artefact.name,
                      {artefact.tool_S_mm ? Kind::target_on_tool : Kind::artefact, k});
    }
    if (used.bar && setup.ballbar->free_cup) add_place(list, "cup", {Kind::cup});
    if (used.bar && setup.ballbar->free_length)
        list.push_back({"length_mm", "mm", 0.1, {Kind::length}});
    for (const auto& [stylus, extension_mm] : used.extensions)
        add_place(list, fmt::format("{}{:+}", stylus ? "stylus" : "cup", extension_mm),
                  {stylus ? Kind::stylus : Kind::long_cup, 0, 0, extension_mm});
    for (int k = 0; k < static_cast<int>(setup.instruments.size()); ++k) {
        const setup::Instrument& instrument = setup.instruments[static_cast<std::size_t>(k)];
        if (!used.instruments.contains(k)) continue;
        if (instrument.free_pose) add_pose(list, instrument.name, {Kind::instrument, k});
        if (instrument.free_scale)
            list.push_back({instrument.name + ".scale", "1", 1e-4, {Kind::instrument, k, 6}});
    }
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes()) {
        if (!used.encoders.contains(axis.axis)) continue;
        list.push_back({axis.name + (axis.rotary ? ".encoder_zero_rad" : ".encoder_zero_mm"),
                        axis.rotary ? "rad" : "mm",
                        axis.rotary ? 1e-4 : 0.1,
                        {Kind::encoder, static_cast<int>(index_of(axis.axis))}});
    }
    return list;
}

}  // namespace

std::vector<FreeQuantity> free_quantities(const setup::Setup& setup,
                                          const emulator::Replay& replay) {
    std::vector<FreeQuantity> list;
    int slot = static_cast<int>(replay.zeros().size());
    for (std::size_t s = 0; s < replay.sessions().size(); ++s)
        for (FreeQuantity& free : quantities_of(setup, used_by(replay, s))) {
            if (replay.sessions().size() > 1) {
                free.place.session_name = replay.sessions()[s];
                free.name += '.' + free.place.session_name;
            }
            free.place.session = static_cast<int>(s);
            if (s > 0) free.place.slot = slot++;
            list.push_back(std::move(free));
        }
    add_zeros(list, replay);
    return list;
}

void begin_sessions(setup::Setup& setup, const emulator::Replay& replay) {
    setup.zeros.assign(replay.zeros().size(), 0.0);
    for (const FreeQuantity& free : free_quantities(setup, replay)) {
        if (free.place.kind == Kind::zero) continue;
        SetUpQuantity first = free.place;
        first.session = 0;
        setup::Setup own = replay.setup_of(static_cast<std::size_t>(free.place.session));
        const double begin = number_of(own, first);
        if (free.place.session == 0)
            number_of(setup, first) = begin;
        else
            setup.zeros.push_back(begin);
    }
}

void keep_sessions(setup::Setup& fitted, const emulator::Replay& replay) {
    if (replay.sessions().size() < 2) return;
    for (const FreeQuantity& free : free_quantities(fitted, replay)) {
        if (free.place.kind == Kind::zero) continue;
        const std::string& session =
            replay.sessions()[static_cast<std::size_t>(free.place.session)];
        if (session.empty()) continue;
        auto at = std::find_if(fitted.sessions.begin(), fitted.sessions.end(),
                               [&](const auto& s) { return s.name == session; });
        if (at == fitted.sessions.end()) at = fitted.sessions.insert(at, {session, {}});
        at->values[free.quantity] = number_of(fitted, free.place);
    }
}

double& number_of(setup::Setup& setup, const SetUpQuantity& q) {
    const auto k = static_cast<std::size_t>(q.index);
    if (q.session > 0) return setup.zeros.at(static_cast<std::size_t>(q.slot));
    switch (q.kind) {
        case Kind::cup: return setup.ballbar->cup_S_mm(q.component);
        case Kind::stylus:
            return ball_of(setup.probe->extension_errors, q.extension_mm)(q.component);
        case Kind::long_cup:
            return ball_of(setup.ballbar->extension_errors, q.extension_mm)(q.component);
        case Kind::instrument: return number_of(setup.instruments[k], q.component);
        case Kind::zero: return setup.zeros.at(k);
        case Kind::encoder: return setup.encoder_zero.at(k);
        case Kind::artefact:
        case Kind::target_on_tool: return place_of(setup.artefacts[k])(q.component);
        default: return setup.ballbar->length_mm;
    }
}

double set_up_derivative(const SetUpQuantity& q, const emulator::Replay& replay, std::size_t i,
                         const kinematics::Perturbation& gradient) {
    const emulator::Contact& contact = replay.contact(i);
    if (q.kind != Kind::zero && static_cast<std::size_t>(q.session) != replay.session(i))
        return 0.0;
    const bool bar = contact.device == records::Device::ballbar;
    const bool same_length = contact.extension_mm == q.extension_mm;
    switch (q.kind) {
        case Kind::artefact: return artefact_derivative(q, contact, gradient, false);
        case Kind::target_on_tool: return artefact_derivative(q, contact, gradient, true);
        case Kind::instrument:
            if (contact.instrument != q.index) return 0.0;
            return instrument_derivative(q, contact,
                                         replay.setup_of(replay.session(i))
                                             .instruments[static_cast<std::size_t>(q.index)]
                                             .pose_error);
        case Kind::zero: return contact.zero == q.index ? 1.0 : 0.0;
        case Kind::encoder: return is_read_by(q, contact) ? 1.0 : 0.0;
        case Kind::cup: return bar ? gradient.tip_shift_mm(q.component) : 0.0;
        case Kind::length: return bar ? -1.0 : 0.0;
        case Kind::long_cup: return bar && same_length ? gradient.tip_shift_mm(q.component) : 0.0;
        case Kind::stylus: return !bar && same_length ? gradient.tip_shift_mm(q.component) : 0.0;
        default: return 0.0;
    }
}

namespace {

emulator::ReplayOffsets offsets_between(const setup::Setup& from, const setup::Setup& to) {
    emulator::ReplayOffsets offsets;
    for (std::size_t k = 0; k < from.artefacts.size(); ++k) {
        setup::Artefact was = from.artefacts[k], is = to.artefacts[k];
        offsets.artefact.push_back(place_of(is) - place_of(was));
    }
    for (std::size_t k = 0; k < from.instruments.size(); ++k) {
        const setup::Instrument &was = from.instruments[k], &is = to.instruments[k];
        offsets.instruments.push_back({{is.pose_error.shift_mm - was.pose_error.shift_mm,
                                        is.pose_error.tilt_rad - was.pose_error.tilt_rad},
                                       is.scale_error - was.scale_error});
    }
    for (std::size_t k = 0; k < axis_count; ++k)
        offsets.encoder_zero[k] = to.encoder_zero[k] - from.encoder_zero[k];
    if (from.probe)
        offsets.stylus_S = difference(from.probe->extension_errors, to.probe->extension_errors);
    if (!from.ballbar) return offsets;
    offsets.long_cup_S = difference(from.ballbar->extension_errors, to.ballbar->extension_errors);
    offsets.cup_S = to.ballbar->cup_S_mm - from.ballbar->cup_S_mm;
    offsets.length = to.ballbar->length_mm - from.ballbar->length_mm;
    return offsets;
}

/// The setup in the k-th session.
setup::Setup in_session(const emulator::Replay& replay, setup::Setup fitted,
                        const std::vector<FreeQuantity>& quantities, int session) {
    const auto k = static_cast<std::size_t>(session);
    const bool has_own = replay.setup().find_session(replay.sessions()[k]) != nullptr;
    setup::Setup own = has_own ? replay.setup_of(k) : fitted;
    for (const FreeQuantity& free : quantities) {
        if (free.place.session != session || free.place.kind == Kind::zero) continue;
        SetUpQuantity first = free.place;
        first.session = 0;
        number_of(own, first) = number_of(fitted, free.place);
    }
    return own;
}

}  // namespace

emulator::ReplayOffsets offsets_to(const emulator::Replay& replay, const setup::Setup& fitted) {
    const std::vector<std::string>& sessions = replay.sessions();
    const bool plain = sessions.empty() || !replay.setup().find_session(sessions.front());
    emulator::ReplayOffsets offsets;
    if (plain) offsets = offsets_between(replay.setup(), fitted);
    const std::size_t zeros = std::min(fitted.zeros.size(), replay.zeros().size());
    const auto end = fitted.zeros.begin() + static_cast<std::ptrdiff_t>(zeros);
    if (plain && sessions.size() < 2) {
        offsets.zeros.assign(fitted.zeros.begin(), end);
        return offsets;
    }
    const std::vector<FreeQuantity> quantities = free_quantities(replay.setup(), replay);
    const auto of = [&](int session) {
        return offsets_between(replay.setup_of(static_cast<std::size_t>(session)),
                               in_session(replay, fitted, quantities, session));
    };
    if (!plain) offsets = of(0);
    offsets.zeros.assign(fitted.zeros.begin(), end);
    for (int s = 1; s < static_cast<int>(sessions.size()); ++s)
        offsets.later_sessions.push_back(of(s));
    return offsets;
}

}  // namespace trunnion::identification
