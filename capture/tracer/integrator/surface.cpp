#include "capture/tracer/integrator/surface.hpp"

#include "rayspace/light/directions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace rs::capture {

namespace {

glm::vec3 reflect_about_normal(const glm::vec3& wo) {
    return {-wo.x, -wo.y, wo.z};
}

}  // namespace

std::vector<SurfaceModel> make_surface_models(const std::vector<Material>& materials) {
    std::map<std::tuple<SurfaceKind, float, float>, std::shared_ptr<const AlbedoTable>> tables;
    std::vector<SurfaceModel> models;
    models.reserve(materials.size());
    for (const Material& material : materials) {
        SurfaceModel model{material.kind, std::max(material.roughness * material.roughness, kMinAlpha), material.ior,
                           material.kind == SurfaceKind::diffuse ? material.translucency : 0.0F, nullptr};
        if (model.kind == SurfaceKind::metal) {
            auto& table = tables[{model.kind, model.alpha, 0.0F}];
            if (!table) table = std::make_shared<AlbedoTable>(AlbedoTable::conductor(model.alpha));
            model.albedo = table;
        } else if (model.kind == SurfaceKind::glossy) {
            auto& table = tables[{model.kind, model.alpha, model.ior}];
            if (!table) table = std::make_shared<AlbedoTable>(AlbedoTable::dielectric(model.alpha, model.ior));
            model.albedo = table;
        }
        models.push_back(std::move(model));
    }
    return models;
}

Surface::Surface(const SurfaceModel& model, const glm::vec3& colour, const glm::vec3& wo, bool leaving)
    : model_(model), colour_(colour), wo_(wo), leaving_(leaving) {
    if (model.albedo) {
        albedo_ = model.albedo->at(wo.z);
        lambda_ = smith_lambda(wo, model.alpha);
    }
    if (model.kind == SurfaceKind::glossy) {
        const float base = (1.0F - albedo_) * luminance(colour);
        coat_probability_ = std::clamp(albedo_ / (albedo_ + base + 1e-6F), 0.05F, 1.0F);
    }
}

Surface::Value Surface::evaluate(const glm::vec3& wi) const {
    const float cos_in = std::abs(wi.z);
    switch (model_.kind) {
        case SurfaceKind::diffuse: {
            const float share = wi.z > 0.0F ? 1.0F - model_.translucency : model_.translucency;
            return {colour_ * (share * cos_in / kPiF), share * cos_in / kPiF};
        }
        case SurfaceKind::glossy: {
            if (wi.z <= 0.0F) return {};
            const MicrofacetValue coat = evaluate_microfacet(wo_, wi, model_.alpha, lambda_);
            const float reflected = fresnel_dielectric(coat.cos_facet, model_.ior);
            const float through =
                (1.0F - albedo_) * (1.0F - model_.albedo->at(wi.z)) / std::max(1.0F - model_.albedo->mean(), 1e-4F);
            return {glm::vec3(coat.f_cos * reflected) + colour_ * (through * cos_in / kPiF),
                    coat_probability_ * coat.pdf + (1.0F - coat_probability_) * cos_in / kPiF};
        }
        case SurfaceKind::metal: {
            if (wi.z <= 0.0F) return {};
            const MicrofacetValue facets = evaluate_microfacet(wo_, wi, model_.alpha, lambda_);
            const glm::vec3 reflected = fresnel_schlick(facets.cos_facet, colour_);
            const glm::vec3 rescattered = glm::vec3(1.0F) + colour_ * ((1.0F - albedo_) / std::max(albedo_, 1e-3F));
            return {reflected * rescattered * facets.f_cos, facets.pdf};
        }
        case SurfaceKind::mirror:
        case SurfaceKind::glass:
            return {};
    }
    return {};
}

bool Surface::sample(float u_lobe, const glm::vec2& u, SurfaceSample& drawn) const {
    if (is_specular()) return sample_specular(u_lobe, drawn);
    if (model_.kind == SurfaceKind::diffuse) {
        drawn.direction = sample_cosine_hemisphere(u);
        if (u_lobe < model_.translucency) drawn.direction.z = -drawn.direction.z;
    } else if (model_.kind == SurfaceKind::metal || u_lobe < coat_probability_) {
        const glm::vec3 normal = sample_visible_normal(wo_, model_.alpha, u);
        drawn.direction = 2.0F * glm::dot(wo_, normal) * normal - wo_;
    } else {
        drawn.direction = sample_cosine_hemisphere(u);
    }
    const Value value = evaluate(drawn.direction);
    if (!(value.pdf > 1e-12F)) return false;
    drawn.weight = value.f_cos / value.pdf;
    drawn.pdf = value.pdf;
    drawn.specular = false;
    return true;
}

SurfaceSample Surface::reflected(const glm::vec3& weight) const {
    return {reflect_about_normal(wo_), weight, 0.0F, true};
}

float Surface::relative_ior() const {
    return leaving_ ? 1.0F / model_.ior : model_.ior;
}

SurfaceSample Surface::refracted(const glm::vec3& weight) const {
    const float eta = relative_ior();
    const float cos_refracted = std::sqrt(std::max(0.0F, 1.0F - (1.0F - wo_.z * wo_.z) / (eta * eta)));
    return {{-wo_.x / eta, -wo_.y / eta, -cos_refracted}, weight, 0.0F, true};
}

bool Surface::sample_specular(float u_lobe, SurfaceSample& drawn) const {
    if (model_.kind == SurfaceKind::mirror) {
        drawn = reflected(colour_);
        return true;
    }
    // Sampled with its own probability, so the weight is 1.
    const bool back = u_lobe < fresnel_dielectric(wo_.z, relative_ior());
    drawn = back ? reflected(glm::vec3(1.0F)) : refracted(glm::vec3(1.0F));
    return true;
}

std::vector<SurfaceSample> Surface::specular_directions() const {
    switch (model_.kind) {
        case SurfaceKind::mirror:
            return {reflected(colour_)};
        case SurfaceKind::metal:
            return {reflected(fresnel_schlick(wo_.z, colour_))};
        case SurfaceKind::glass: {
            const float back = fresnel_dielectric(wo_.z, relative_ior());
            if (back >= 1.0F) return {reflected(glm::vec3(1.0F))};
            return {reflected(glm::vec3(back)), refracted(glm::vec3(1.0F - back))};
        }
        default:
            return {};
    }
}

}  // namespace rs::capture
