//! Shaders with values for their constants. What the constants rule out is taken away before a driver sees a shader: lavapipe puts every function
//! in the place of each of its calls before it looks at conditions, and then needs ten times as long (1.7 s where it needs 0.15 for the
//! default scene).

use naga::{
    Arena, Block, Expression, Handle, Literal, Module, Statement, WithSpan,
    back::pipeline_constants::process_overrides,
    compact::{KeepUnused, compact},
    valid::{Capabilities, ValidationFlags, Validator},
};

use super::shaders::{Composed, ShaderError};

/// A shader of one entry point, without constants that are left open.
pub struct Specialised {
    /// The shader.
    pub module: Module,
    /// Numbers of the bindings that it has a use for.
    pub bindings: Vec<u32>,
}

/// The shader of an entry point of a pass, with a value for each of the constants that the pass leaves open.
pub fn specialised(
    composed: &Composed,
    entry: &str,
    constants: &[(&'static str, f64)],
) -> Result<Specialised, ShaderError> {
    let wgsl = composed.wgsl.as_str();
    let refused =
        |line: Option<u32>, message: String| ShaderError { place: composed.place(line.unwrap_or(1) as usize), message };
    let module = naga::front::wgsl::parse_str(wgsl)
        .map_err(|error| refused(error.location(wgsl).map(|at| at.line_number), error.message().to_owned()))?;
    // What a device can do is checked when it gets the shader.
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator.validate(&module).map_err(|error| {
        let line = error.location(wgsl).map(|at| at.line_number);
        refused(line, with_causes(&error))
    })?;
    let point = module.entry_points.iter().find(|point| point.name == entry);
    let point = point.ok_or_else(|| refused(None, format!("there is no entry point `{entry}`")))?;
    let constants = constants.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    let (module, _) = process_overrides(&module, &info, Some((point.stage, entry)), &constants)
        .map_err(|error| refused(None, error.to_string()))?;
    let mut module = module.into_owned();
    let functions = module.functions.iter_mut().map(|(_, function)| function);
    for function in functions.chain(module.entry_points.iter_mut().map(|point| &mut point.function)) {
        fold(&mut function.body, &function.expressions);
        // An expression with a name would be kept although the branch that it stood in is gone.
        function.named_expressions.clear();
    }
    compact(&mut module, KeepUnused::No);
    let bindings = module.global_variables.iter().filter_map(|(_, variable)| Some(variable.binding?.binding)).collect();
    Ok(Specialised { module, bindings })
}

/// An error with all of its causes.
fn with_causes(error: &WithSpan<impl std::error::Error>) -> String {
    let causes = std::iter::successors(Some(error.as_inner() as &dyn std::error::Error), |error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

/// Puts the branch that is taken in the place of each `if` whose condition is known.
fn fold(block: &mut Block, expressions: &Arena<Expression>) {
    let mut folded = Block::with_capacity(block.len());
    for (statement, span) in std::mem::take(block).span_into_iter() {
        match statement {
            Statement::If { condition, mut accept, mut reject } => {
                fold(&mut accept, expressions);
                fold(&mut reject, expressions);
                match known(condition, expressions) {
                    Some(true) => folded.extend_block(accept),
                    Some(false) => folded.extend_block(reject),
                    None => folded.push(Statement::If { condition, accept, reject }, span),
                }
            }
            Statement::Block(mut inner) => {
                fold(&mut inner, expressions);
                folded.push(Statement::Block(inner), span);
            }
            Statement::Loop { mut body, mut continuing, break_if } => {
                fold(&mut body, expressions);
                fold(&mut continuing, expressions);
                folded.push(Statement::Loop { body, continuing, break_if }, span);
            }
            Statement::Switch { selector, mut cases } => {
                cases.iter_mut().for_each(|case| fold(&mut case.body, expressions));
                folded.push(Statement::Switch { selector, cases }, span);
            }
            other => folded.push(other, span),
        }
        // Nothing may stand after a return that took the place of a branch.
        if folded.last().is_some_and(Statement::is_terminator) {
            break;
        }
    }
    *block = folded;
}

fn known(condition: Handle<Expression>, expressions: &Arena<Expression>) -> Option<bool> {
    match expressions[condition] {
        Expression::Literal(Literal::Bool(value)) => Some(value),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shaders::Library;

    fn backdrop(on_bath: bool) -> Result<Specialised, ShaderError> {
        let composed = Library::Embedded.compose("backdrop").unwrap();
        let on_bath = f64::from(u8::from(on_bath));
        let constants =
            [("ON_BATH", on_bath), ("FULL_PRECISION", 0.0), ("BACKDROP_IS_ENVIRONMENT", 1.0), ("LAMPS", 0.0)];
        specialised(&composed, "backdrop", &constants)
    }

    #[test]
    fn what_constants_rule_out_is_gone() {
        let [whole, folded] = [true, false].map(|on_bath| backdrop(on_bath).unwrap().module);
        let statements = |module: &Module| -> usize { module.functions.iter().map(|(_, f)| f.body.len()).sum() };
        assert!(statements(&folded) < statements(&whole), "{} of {}", statements(&folded), statements(&whole));
        assert_eq!(folded.entry_points.len(), 1);
        assert!(folded.overrides.is_empty());
    }

    #[test]
    fn bindings_without_a_use_are_left_out() {
        let wgsl = "override READS: bool;\n\
            @group(0) @binding(0) var<storage, read_write> result: array<u32>;\n\
            @group(0) @binding(7) var<storage, read> source: array<u32>;\n\
            fn value_of() -> u32 { if (!READS) { return 1u; } let value = source[0]; return value; }\n\
            @compute @workgroup_size(1) fn main() { result[0] = value_of(); }";
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("pass")).unwrap();
        std::fs::write(folder.path().join("pass/some.wgsl"), wgsl).unwrap();
        let composed = Library::Directory(folder.path().to_owned()).compose("some").unwrap();
        for (reads, bindings) in [(1.0, vec![0, 7]), (0.0, vec![0])] {
            let shader = specialised(&composed, "main", &[("READS", reads)]).unwrap();
            assert_eq!(shader.bindings, bindings);
            let checked = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&shader.module);
            assert!(checked.is_ok(), "{checked:?}");
        }
    }

    #[test]
    fn an_error_has_the_file_and_line_that_it_stands_in() {
        let mut composed = Library::Embedded.compose("backdrop").unwrap();
        let line = composed.wgsl.lines().position(|line| line.starts_with("fn backdrop_radiance")).unwrap();
        let mut lines: Vec<_> = composed.wgsl.lines().map(str::to_owned).collect();
        lines[line] = lines[line].replace("fn ", "fun ");
        composed.wgsl = lines.join("\n");
        let error = specialised(&composed, "backdrop", &[]).err().unwrap();
        assert_eq!(error.place, composed.place(line + 1));
        assert!(error.place.starts_with("light/environment.wgsl:"), "{error}");
    }
}
