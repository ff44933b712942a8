//! Many numbers as bytes, in serde: for products of threads that share no memory. To be named in `#[serde(with = "…")]`.

use bytemuck::Pod;
use serde::{Deserialize, Deserializer, Serializer, de::Error};

/// Writes numbers as the machine has them.
pub fn serialize<T: Pod, S: Serializer>(values: &[T], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytemuck::cast_slice(values))
}

/// Reads numbers that were written by the same program.
pub fn deserialize<'de, T: Pod, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<T>, D::Error> {
    let bytes = <&[u8]>::deserialize(deserializer)?;
    if bytes.len() % size_of::<T>() != 0 {
        return Err(D::Error::invalid_length(bytes.len(), &"whole numbers"));
    }
    Ok(bytemuck::pod_collect_to_vec(bytes))
}
