// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "solver/core/cell_list.hpp"
#include "solver/core/contact_surface.hpp"
#include "solver/core/rigid_bodies.hpp"
#include "solver/core/step_total.hpp"
#include "solver/core/step_updated.hpp"

namespace scarp {

/// A body as contact sees it: points with an area. Of a total-Lagrangian body those of its surface; of an
/// updated-Lagrangian one all particles, as balls of half their spacing; of a free rigid one points all over its
/// boundary, or if it is a ball its centre, with its radius.
struct ContactBody {
  std::int32_t body = 0;  ///< index into Model::bodies
  bool total = false;
  std::size_t begin = 0;  ///< first particle of an updated-Lagrangian body
  double spacing = 0;     ///< of its particles, m
  ContactSurface surface;
  std::int32_t rigid = -1;             ///< which of RigidBodies, or none
  std::vector<Vec3> reference;         ///< of a rigid body: places in the reference configuration
  std::vector<double> modulus;         ///< rho c_p^2 of the point's material, Pa
  std::vector<std::int32_t> material;  ///< index into Model::materials
  std::vector<double> area, radius;    ///< m2 (2D: m), m; no radius on a surface
  std::vector<double> fit;             ///< of a ball: the radius is this times half the edge of its volume
  std::vector<double> mobility;        ///< see ContactSurface
  std::vector<Vec3> y, n;              ///< place (of live points) and outward normal when last seen; no normal of balls
  std::vector<Vec3> moved;             ///< of y since the update before, of live points
  std::vector<Vec3> seen;              ///< y when the geometry was found last
  std::vector<double> seen_at;         ///< s
  std::vector<Vec3> force;             ///< on the live points, N
  std::vector<double> stiffness;       ///< of the springs at the live points, N/m
  std::vector<Vec3> list_anchor, geometry_anchor;  ///< see TotalLagrangian::contact_shift
  std::vector<std::uint32_t> active;               ///< points that may touch before the lists are made anew, ascending
  std::vector<std::uint32_t> live;                 ///< of these, those that may touch before the geometry is found anew
  std::vector<std::uint8_t> is_active, is_live;
  Box3 box;
  CellList cells;
  bool pressed = false;  ///< whether some force is not zero

  std::size_t size() const { return area.size(); }
};

/// The points of one body against the surface of another, or of its own where it folds.
struct ContactLink {
  struct Candidate {
    std::uint32_t point = 0;
    std::uint32_t begin = 0, end = 0;  ///< range in `masters`
    // As found last:
    bool live = false;
    std::uint32_t shares_begin = 0, shares_end = 0;  ///< range in `shares`
    Vec3 n{0, 0, 0};                                 ///< of the other body, outward
    double stiffness = 0;                            ///< N/m
    double friction = 0;
  };
  /// A point of the other body that takes part of the force.
  struct Share {
    std::uint32_t point = 0;
    double part = 0;  ///< of the candidate's force; they sum to 1
  };
  std::size_t slave = 0, master = 0;  ///< which ContactBody
  double share = 1;                   ///< of the springs; half where the bodies look at each other in turn
  std::optional<double> friction;     ///< of this pair of bodies; else that of the materials holds
  std::vector<Candidate> candidates;
  std::vector<std::uint32_t> masters;
  std::vector<Share> shares;           ///< of live candidates
  std::vector<Vec3> slid;              ///< per point: over the masters since the update before, m
  std::vector<Vec3> stretch;           ///< per point: of the tangential spring, m
  std::vector<std::uint8_t> touching;  ///< per point
};

/// The points of one body against a face of the domain with friction that none of its nodes stood on at the start.
struct ContactFace {
  std::size_t body = 0;  ///< which ContactBody
  int axis = 0;
  double inward = 1;  ///< along the axis: 1 on a lower face, -1 on an upper one
  double place = 0;   ///< m, on the axis
  double friction = 0;
  std::vector<std::uint32_t> candidates;
  std::vector<double> stiffness;       ///< per point, N/m: of springs that may be met before the geometry is found anew
  std::vector<Vec3> stretch;           ///< per point, m
  std::vector<std::uint8_t> touching;  ///< per point
};

/// The points of one body against the surface of a rigid one (contact_walls.cpp).
struct ContactWall {
  std::size_t body = 0;          ///< which ContactBody
  std::size_t rigid = 0;         ///< which of RigidBodies
  double share = 1;              ///< of the springs; half where two rigid bodies look at each other in turn
  std::vector<double> friction;  ///< per material of the points; infinite where the wall is rough
  double modulus = 0;            ///< of springs at most, Pa
  double reach = 0;              ///< of the points, m
  std::vector<std::uint32_t> candidates;
  // Per point:
  std::vector<Vec3> stretch;  ///< of the tangential spring, m
  std::vector<std::uint8_t> touching;
  std::vector<Vec3> facing;         ///< of the sheet that it touches, in the rigid body's frame; else zero
  std::vector<Vec3> last;           ///< where it was in that frame, m
  std::vector<std::uint64_t> seen;  ///< in which update
  std::vector<double> clear;        ///< m: as far from the surface, at least, when it was looked for last
  std::vector<Vec3> clear_at;       ///< where that was, in the rigid body's frame, m

  /// How far point i, at z, is from the surface for certain; 0 where it may be inside.
  double clear_of(std::uint32_t i, const Vec3& z) const {
    return clear[i] > 0 ? std::max(0.0, clear[i] - norm(z - clear_at[i])) : 0;
  }
};

/// Contact by springs between the surfaces of total-Lagrangian bodies, and between them and the particles of
/// updated-Lagrangian ones, in the current configuration.
///
/// A point looks at the points q of the other surface within two spacings: their planes (y_q, n_q), averaged with
/// weights w_q = A_q (1 - |y - y_q|^2 / R^2)^2, are a smooth surface (moving least squares of planes: Shen, O'Brien,
/// Shewchuk 2004; Kolluri 2005). The depth d below it gives the pressure k d along the averaged normal, with k =
/// stiffness x P-wave modulus / spacing, whatever the time step; a tangential spring of the same stiffness stretches
/// with the relative motion and slips at Coulomb's limit (Cundall and Strack 1979). The point's force is taken from the
/// points q in proportion to w_q: forces sum to nothing. Beyond the rim of an open patch of surface the springs fade.
///
/// A face of the domain with friction stops total-Lagrangian bodies that come to it in the same way. Those with nodes
/// on it at the start are NodeFaces' business.
///
/// Rigid bodies are met by the distance to their surface, whose gradient is the normal; a point remembers by which side
/// it came, and the way that it has gone since the step before tells whether it has come through one, so that no wall
/// is too thin.
///
/// Points near enough to matter are listed, and the lists hold until something has moved half their margin. The
/// geometry (the averaged normals, the shares w_q / sum w, the springs' stiffness) holds until something has moved by a
/// fiftieth of a spacing; in between depths follow the points, which is a linear, conservative spring between them. A
/// step looks at the points alone that may touch until then and allocates nothing once buffers have grown. Serial; same
/// bits for any threads.
class Contact {
 public:
  /// @param total, updated, rigid  steppers of the model's bodies; none where there are no such bodies; outlive this
  ///                               object
  /// @throws Error ("solve") where bodies overlap at the start.
  Contact(const Model& model, TotalLagrangian* total, UpdatedLagrangian* updated, RigidBodies* rigid = nullptr);

  /// Finds the forces of the state as it stands.
  void update();
  /// Gives them to the bodies for a step of dt.
  void push(double dt);
  /// s: the largest step that is stable for the springs as they stand, times courant, or a quarter at least where only
  /// total-Lagrangian bodies meet; and one in which no point gets past what it comes to. Infinite where nothing does.
  double stable_time_step(double courant) const;

  double stored() const { return stored_; }      ///< in springs, J
  double friction() const { return friction_; }  ///< lost so far, J
  /// Mean force on each body since the last call, N. Its integral over a history is the impulse.
  std::vector<Vec3> take_mean_force();

 private:
  struct Touch;
  void add_total_body(std::int32_t body, std::size_t index);
  void add_updated_body(std::int32_t body);
  void size_buffers(ContactBody& body);
  void add_links();
  void add_faces();
  void add_rigid_points(std::size_t rigid);
  void add_walls();
  std::vector<double> friction_of(const ContactBody& body, const RigidBody& wall) const;
  void add_wall(std::size_t body, std::size_t rigid, double share);
  void limit_rigid_step(const ContactBody& points, const RigidBody& wall, double modulus);
  void refuse_overlap(const ContactWall& wall) const;
  void locate_rigid(ContactBody& body, const std::vector<std::uint32_t>& points, std::size_t count);
  void set_anchor(std::vector<RigidState>& anchor) const;
  double shift_of_rigid(const std::vector<RigidState>& anchor) const;
  void find_fastest();
  double time_to_go() const;
  void list_candidates(ContactWall& wall);
  void find_geometry(ContactWall& wall);
  double stiffness_of(const ContactWall& wall, std::uint32_t point) const;
  bool is_near(ContactWall& wall, std::uint32_t point, const Vec3& z, double distance) const;
  void find_forces(ContactWall& wall);
  bool look(ContactWall& wall, std::uint32_t point, const Vec3& z, Touch& touch) const;
  void press(ContactWall& wall, std::uint32_t point, const Vec3& z, const Touch& touch);
  void leave(ContactWall& wall, std::uint32_t point, double stiffness);
  void fit_balls();
  void fit_ball(ContactBody& body, std::uint32_t point, double depth);
  void refuse_overlap() const;
  double reach(const ContactBody& a, const ContactBody& b) const { return 2 * std::max(a.spacing, b.spacing); }
  double farthest_shift(std::vector<Vec3> ContactBody::*anchor) const;
  void set_anchor(ContactBody& body, std::vector<Vec3>& anchor) const;
  void locate(ContactBody& body, const std::vector<std::uint32_t>& points, std::size_t count, bool normals);
  void follow(ContactBody& body);
  void make_lists();
  void list_candidates(ContactLink& link);
  void list_candidates(ContactFace& face);
  void find_slides(ContactLink& link);
  void find_geometry();
  void find_geometry(ContactLink& link);
  void find_geometry(ContactFace& face);
  bool look(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch);
  void stand_above(const ContactLink& link, const ContactLink::Candidate& candidate, Touch& touch);
  Vec3 motion(const ContactBody& body, std::uint32_t point) const;
  void make_live(ContactLink& link, ContactLink::Candidate& candidate, const Touch& touch);
  void find_forces(ContactLink& link, bool slides_known);
  void find_forces(ContactFace& face);
  Vec3 rub(Vec3& stretch, bool touched, const Vec3& slid, const Vec3& n, double stiffness, double friction,
           double depth);
  double friction_of(const ContactLink& link, std::uint32_t point, std::uint32_t master) const;

  const Model& model_;
  TotalLagrangian* total_;
  UpdatedLagrangian* updated_;
  int dimension_;
  std::vector<ContactBody> bodies_;
  std::vector<std::size_t> total_index_;  ///< per body: which of TotalLagrangian's
  std::vector<ContactLink> links_;
  std::vector<ContactFace> faces_;
  RigidBodies* rigid_;
  std::vector<ContactWall> walls_;
  double rigid_step_ = INFINITY;  ///< stable for springs of free rigid bodies to come, at courant 1, s
  std::vector<RigidState> rigid_list_anchor_, rigid_geometry_anchor_;
  double fastest_ = 0;                     ///< of the live points, m/s
  std::uint64_t updates_ = 2;              ///< so that nothing has been seen in the one before
  std::vector<double> material_friction_;  ///< per pair of materials
  struct NearMaster {
    std::uint32_t point;
    double weight;
    Vec3 d;  ///< from the candidate to it, m
  };
  std::vector<NearMaster> near_;           ///< of the candidate that is looked at
  std::vector<std::uint32_t> everything_;  ///< 0, 1, 2, ...
  std::vector<std::uint32_t> pushed_;      ///< particles of updated-Lagrangian bodies, with forces
  std::vector<Vec3> pushes_;
  double margin_ = 0;          ///< of the lists, m
  double allowed_ = 0;         ///< shift until they are made anew, m
  double steady_ = 0;          ///< shift until the geometry is found anew, m
  double time_ = 0;            ///< that has passed, s
  std::vector<Vec3> net_;      ///< force on each body of the model as it stands, N
  std::vector<Vec3> impulse_;  ///< since the last take_mean_force, N s
  double elapsed_ = 0;
  double last_step_ = 0, longest_step_ = 0;  ///< s
  double stored_ = 0, friction_ = 0;
};

}  // namespace scarp
