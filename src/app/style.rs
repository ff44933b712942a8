//! How the panels look: quiet, without colours that would compete with the bubble; dark, or light for bright rooms.

use egui::{Color32, Context, CornerRadius, Stroke, Theme, Visuals, vec2};

/// Marks what is chosen.
const ACCENT: Color32 = Color32::from_rgb(58, 76, 92);

/// Sets the style of a new context.
pub fn apply(ctx: &Context) {
    ctx.set_theme(Theme::Dark);
    // One pass a frame: a second one would toggle what the first one has toggled.
    ctx.options_mut(|options| options.max_passes = std::num::NonZeroUsize::MIN);
    ctx.style_mut_of(Theme::Dark, |style| style.visuals = dark());
    ctx.all_styles_mut(|style| {
        style.spacing.item_spacing = vec2(6.0, 5.0);
        style.spacing.button_padding = vec2(6.0, 2.0);
        style.spacing.interact_size.y = 20.0;
        style.spacing.combo_width = 80.0;
        style.interaction.tooltip_delay = 0.6;
        style.animation_time = 0.08;
    });
}

fn dark() -> Visuals {
    let mut visuals = Visuals::dark();
    visuals.panel_fill = Color32::from_gray(22);
    visuals.window_fill = Color32::from_gray(26);
    visuals.extreme_bg_color = Color32::from_gray(14);
    visuals.window_stroke = Stroke::new(1.0, Color32::from_gray(48));
    visuals.selection.bg_fill = ACCENT;
    visuals.selection.stroke = Stroke::new(1.0, Color32::from_gray(225));
    visuals.slider_trailing_fill = true;
    visuals.widgets.noninteractive.bg_stroke = Stroke::new(1.0, Color32::from_gray(38));
    visuals.widgets.noninteractive.fg_stroke = Stroke::new(1.0, Color32::from_gray(168));
    visuals.widgets.inactive.fg_stroke = Stroke::new(1.0, Color32::from_gray(188));
    visuals.widgets.inactive.weak_bg_fill = Color32::from_gray(38);
    visuals.widgets.inactive.bg_fill = Color32::from_gray(44);
    let round = CornerRadius::same(3);
    let widgets = &mut visuals.widgets;
    for state in [&mut widgets.inactive, &mut widgets.hovered, &mut widgets.active, &mut widgets.open] {
        state.corner_radius = round;
    }
    visuals
}
