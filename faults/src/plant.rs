//! Where faults can be, and what they are.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use std::collections::HashSet;
use std::error::Error;
use std::fs;
use syn::spanned::Spanned;
use syn::visit_mut::{self, VisitMut};
use syn::{BinOp, Block, Expr, ReturnType, Signature, Type, UnOp};

/// Rewrites `files` of `tree`, and prints a line for each fault: number, place, function, what is changed.
pub fn plant(share: f64, seed: u64, tree: &str, left_out: &str, files: &[&str]) -> Result<(), Box<dyn Error>> {
    let left_out = fs::read_to_string(left_out)?.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
    let mut planter = Planter {
        file: String::new(),
        call: TokenStream::new(),
        functions: Vec::new(),
        places: 0,
        share,
        left_out,
        random: seed,
    };
    for file in files {
        let path = format!("{tree}/{file}");
        let mut source = syn::parse_file(&fs::read_to_string(&path)?)?;
        planter.file = (*file).to_owned();
        let solver = file.starts_with("solver/");
        planter.call = if solver { quote!(crate::fault) } else { quote!(squeezefilm_solver::fault) };
        planter.visit_file_mut(&mut source);
        fs::write(&path, source.to_token_stream().to_string())?;
    }
    eprintln!("{} places", planter.places);
    Ok(())
}

struct Planter {
    file: String,
    /// The function that says whether a fault is there.
    call: TokenStream,
    /// Names of the functions around the present place.
    functions: Vec<String>,
    places: u32,
    /// Of all places those that get a fault.
    share: f64,
    left_out: HashSet<u32>,
    random: u64,
}

impl Planter {
    /// In [0, 1): splitmix64.
    fn unit(&mut self) -> f64 {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.random ^ (self.random >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn one_of<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[(self.unit() * choices.len() as f64) as usize]
    }

    /// The number of the next place, if it gets a fault.
    fn number(&mut self, line: usize, what: &str) -> Option<u32> {
        self.places += 1;
        let drawn = self.unit() < self.share;
        if !drawn || self.left_out.contains(&self.places) {
            return None;
        }
        let function = self.functions.last().map_or("", String::as_str);
        println!("{}\t{}:{line}\t{function}\t{what}", self.places, self.file);
        Some(self.places)
    }

    fn function(&mut self, signature: &Signature, block: &mut Block) {
        if signature.constness.is_some() {
            return;
        }
        self.functions.push(signature.ident.to_string());
        visit_mut::visit_block_mut(self, block);
        let constants = match &signature.output {
            ReturnType::Default if block.stmts.is_empty() => Vec::new(),
            ReturnType::Default => vec![quote!(())],
            ReturnType::Type(_, returned) => constants(returned),
        };
        if !constants.is_empty() {
            let constant = self.one_of(&constants).clone();
            let line = signature.ident.span().start().line;
            if let Some(number) = self.number(line, &format!("return {constant} at once")) {
                let call = &self.call;
                block.stmts.insert(0, syn::parse_quote!(if #call(#number) { return #constant; }));
            }
        }
        self.functions.pop();
    }
}

/// Constants of a type, if it is one of those that have some.
fn constants(of: &Type) -> Vec<TokenStream> {
    let Type::Path(path) = of else {
        return if matches!(of, Type::Tuple(tuple) if tuple.elems.is_empty()) { vec![quote!(())] } else { Vec::new() };
    };
    let Some(last) = path.path.segments.last() else { return Vec::new() };
    let inner = match &last.arguments {
        syn::PathArguments::AngleBracketed(given) => given.args.iter().find_map(|argument| match argument {
            syn::GenericArgument::Type(of) => Some(constants(of)),
            _ => None,
        }),
        _ => None,
    };
    let inner = inner.unwrap_or_default();
    match last.ident.to_string().as_str() {
        "bool" => vec![quote!(true), quote!(false)],
        "f64" => vec![quote!(0.0), quote!(1.0), quote!(-1.0)],
        "usize" | "u8" | "u32" | "u64" | "i32" | "i64" => vec![quote!(0), quote!(1)],
        "String" => vec![quote!(String::new()), quote!(String::from("xyzzy"))],
        "Vec" => vec![quote!(Vec::new())],
        "Option" => std::iter::once(quote!(None)).chain(inner.iter().map(|value| quote!(Some(#value)))).collect(),
        "Result" => inner.iter().map(|value| quote!(Ok(#value))).collect(),
        _ => Vec::new(),
    }
}

/// What may stand in place of an operator.
fn others(operator: &BinOp) -> &'static [&'static str] {
    match operator {
        BinOp::Add(_) => &["-", "*"],
        BinOp::Sub(_) => &["+", "/"],
        BinOp::Mul(_) => &["+", "/"],
        BinOp::Div(_) => &["%", "*"],
        BinOp::Rem(_) => &["/", "+"],
        BinOp::AddAssign(_) => &["-=", "*="],
        BinOp::SubAssign(_) => &["+=", "/="],
        BinOp::MulAssign(_) => &["+=", "/="],
        BinOp::DivAssign(_) => &["%=", "*="],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::Lt(_) => &["==", ">"],
        BinOp::Le(_) => &[">"],
        BinOp::Gt(_) => &["==", "<"],
        BinOp::Ge(_) => &["<"],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        _ => &[],
    }
}

/// Whether it binds names for what follows, and so cannot be wrapped.
fn binds(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Binary(both) => binds(&both.left) || binds(&both.right),
        _ => false,
    }
}

fn is_test(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| attribute.to_token_stream().to_string().contains("test"))
}

impl VisitMut for Planter {
    fn visit_expr_mut(&mut self, expression: &mut Expr) {
        visit_mut::visit_expr_mut(self, expression);
        let line = expression.span().start().line;
        let (what, faulty) = match expression {
            Expr::Binary(both) if !binds(&both.left) && !binds(&both.right) && !others(&both.op).is_empty() => {
                let other = *self.one_of(others(&both.op));
                let Ok(operator) = syn::parse_str::<BinOp>(other) else { return };
                let changed = syn::ExprBinary { op: operator, ..both.clone() };
                (format!("{other} in place of {}", both.op.to_token_stream()), changed.to_token_stream())
            }
            Expr::Unary(one) if !matches!(one.op, UnOp::Deref(_)) => {
                (format!("no {}", one.op.to_token_stream()), one.expr.to_token_stream())
            }
            _ => return,
        };
        if let Some(number) = self.number(line, &what) {
            let call = &self.call;
            *expression = syn::parse_quote!((if #call(#number) { (#faulty) } else { (#expression) }));
        }
    }

    fn visit_item_fn_mut(&mut self, function: &mut syn::ItemFn) {
        if !is_test(&function.attrs) {
            self.function(&function.sig, &mut function.block);
        }
    }

    fn visit_impl_item_fn_mut(&mut self, function: &mut syn::ImplItemFn) {
        self.function(&function.sig, &mut function.block);
    }

    fn visit_trait_item_fn_mut(&mut self, function: &mut syn::TraitItemFn) {
        if let Some(block) = &mut function.default {
            self.function(&function.sig, block);
        }
    }

    fn visit_item_mod_mut(&mut self, module: &mut syn::ItemMod) {
        if !is_test(&module.attrs) {
            visit_mut::visit_item_mod_mut(self, module);
        }
    }

    // Room that is made beforehand changes no result.
    fn visit_expr_call_mut(&mut self, call: &mut syn::ExprCall) {
        if !call.func.to_token_stream().to_string().ends_with("with_capacity") {
            visit_mut::visit_expr_call_mut(self, call);
        }
    }

    // What has to be known when it is compiled.
    fn visit_item_const_mut(&mut self, _: &mut syn::ItemConst) {}
    fn visit_item_static_mut(&mut self, _: &mut syn::ItemStatic) {}
    fn visit_impl_item_const_mut(&mut self, _: &mut syn::ImplItemConst) {}
    fn visit_trait_item_const_mut(&mut self, _: &mut syn::TraitItemConst) {}
    fn visit_type_mut(&mut self, _: &mut Type) {}
    fn visit_pat_mut(&mut self, _: &mut syn::Pat) {}
    fn visit_expr_repeat_mut(&mut self, array: &mut syn::ExprRepeat) {
        self.visit_expr_mut(&mut array.expr);
    }
}
