#include "evaluation/truth_log.h"

#include <exception>
#include <optional>
#include <string>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/number_text.h"
#include "sim/cell_world.h"
#include "sim/truth.h"

namespace ringhook {
namespace {

constexpr auto kHooksHeader =
    "time_s,hook,x_m,y_m,z_m,qx,qy,qz,qw,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,"
    "swing_about_x_rad,swing_about_y_rad,pivot_x_m,pivot_y_m,pivot_z_m,swinging,belt_travel_m,"
    "belt_speed_m_s\n";
constexpr auto kRingsHeader =
    "time_s,ring,x_m,y_m,z_m,qx,qy,qz,qw,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s,held,"
    "linked_hook,hanging,touching_gripper,hook_force_N,peak_force_in_grip_N,hook_impulse_N_s,"
    "gripper_impulse_N_s,speed_on_hook_m_s\n";
constexpr auto kArmHeader =
    "time_s,j1_true_rad,j2_true_rad,j3_true_rad,j4_true_rad,j5_true_rad,j6_true_rad,"
    "j1_reported_rad,j2_reported_rad,j3_reported_rad,j4_reported_rad,j5_reported_rad,"
    "j6_reported_rad,x_m,y_m,z_m,qx,qy,qz,qw,gripper_closed,held_ring,grip_force_N\n";
constexpr auto kContactsHeader =
    "time_s,body_a,body_b,x_m,y_m,z_m,normal_x,normal_y,normal_z,normal_force_N,"
    "friction_force_N\n";

/// One line of a table; begins with the time and ends with its destruction.
class Row {
 public:
  Row(std::ostream& out, Time time) : out_(out) { out_ << secondsText(time); }
  ~Row() { out_ << '\n'; }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  Row& operator<<(double value) { return *this << exactText(value); }
  Row& operator<<(int value) { return *this << std::to_string(value); }
  Row& operator<<(std::size_t value) { return *this << std::to_string(value); }
  Row& operator<<(bool value) { return *this << (value ? 1 : 0); }
  Row& operator<<(const std::string& text) {
    out_ << ',' << text;
    return *this;
  }
  Row& operator<<(const Pose& pose) {
    const Eigen::Quaterniond q(pose.linear());
    return *this << Eigen::VectorXd(pose.translation()) << Eigen::VectorXd(q.coeffs());
  }
  Row& operator<<(const Eigen::VectorXd& values) {
    for (const double value : values) {
      *this << value;
    }
    return *this;
  }

 private:
  std::ostream& out_;
};

}  // namespace

struct TruthLog::Tables {
  explicit Tables(const std::filesystem::path& folder)
      : hooks(folder / "hooks.csv"),
        rings(folder / "rings.csv"),
        arm(folder / "arm.csv"),
        contacts(folder / "contacts.csv") {
    hooks.stream() << kHooksHeader;
    rings.stream() << kRingsHeader;
    arm.stream() << kArmHeader;
    contacts.stream() << kContactsHeader;
  }

  void addHooks(const CellTruth& now) {
    for (std::size_t i = 0; i < now.hooks.size(); ++i) {
      const HookTruth& hook = now.hooks[i];
      Row(hooks.stream(), now.time)
          << i << hook.fMo << Eigen::VectorXd(hook.twist_f) << hook.swing_about_x
          << hook.swing_about_y << Eigen::VectorXd(hook.fMp.translation()) << hook.swinging
          << now.belt_travel << now.belt_speed;
    }
  }

  void addRings(const CellTruth& now) {
    for (std::size_t i = 0; i < now.rings.size(); ++i) {
      const RingTruth& ring = now.rings[i];
      if (!ring.in_magazine) {
        Row(rings.stream(), now.time)
            << i << ring.fMr << Eigen::VectorXd(ring.twist_f) << ring.held << ring.linked_hook
            << ring.hanging << ring.touching_gripper << ring.hook_force << ring.peak_force_in_grip
            << ring.hook_impulse << ring.gripper_impulse << ring.speed_on_hook;
      }
    }
  }

  void addArm(const CellTruth& now) {
    Row(arm.stream(), now.time) << Eigen::VectorXd(now.joints)
                                << Eigen::VectorXd(now.reported_joints) << now.fMe
                                << now.gripper_closed << now.held_ring << now.grip_force;
  }

  void addContacts(const CellTruth& now) {
    for (const ContactTruth& contact : now.contacts) {
      Row(contacts.stream(), now.time)
          << contact.body_a << contact.body_b << Eigen::VectorXd(contact.point_f)
          << Eigen::VectorXd(contact.normal_f) << contact.normal_force << contact.friction_force;
    }
  }

  AtomicFile hooks;
  AtomicFile rings;
  AtomicFile arm;
  AtomicFile contacts;
  std::optional<Time> last;
};

TruthLog::TruthLog(const std::filesystem::path& folder, const CellWorld& world,
                   const StereoRig& true_rig)
    : world_(world) {
  saveRig(folder / "cameras.yaml", true_rig);
  tables_ = std::make_unique<Tables>(folder);
}

TruthLog::~TruthLog() {
  try {
    commit();
  } catch (const std::exception&) {
    tables_.reset();
  }
}

void TruthLog::sample() {
  if (!tables_) {
    throw Error("The truth log is closed; nothing can be added to it.");
  }
  if (tables_->last == world_.time()) {
    return;
  }
  const CellTruth now = truth(world_);
  tables_->last = now.time;
  tables_->addHooks(now);
  tables_->addRings(now);
  tables_->addArm(now);
  tables_->addContacts(now);
}

void TruthLog::commit() {
  if (!tables_) {
    return;
  }
  const auto tables = std::move(tables_);
  for (AtomicFile* file : {&tables->hooks, &tables->rings, &tables->arm, &tables->contacts}) {
    file->commit();
  }
}

}  // namespace ringhook
